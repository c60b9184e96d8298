// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_insitu.h"
#include "contact_ids.h"
#include "contact_observer.h"
#include "contact_reader.h"
#include "ellipsoid_surface.h"
#include "gran_insitu_models.h"
#include "kept_history.h"
#include "lane_law.h"
#include "model_names.h"
#include "neighbour_list_watch.h"
#include "pair_checks.h"
#include "run_fixes.h"
#include "sphere_geometry.h"
#include "stop_signal.h"
#include "superquadric_columns.h"
#include "surface_required.h"
#include "taken_setting.h"
#include "tangential_bound.h"
#include "time_level.h"
#include "time_step_watch.h"
#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cstring>
#include <utility>

using namespace LAMMPS_NS;
using grainscope::ContactLaw;
using grainscope::ContactObserver;
using grainscope::ContactReader;
using grainscope::TangentialBound;
using grainscope::TangentialLaw;

struct PairGranInsitu::Impl {
  explicit Impl(LAMMPS *lmp)
      : observer(lmp), reader(observer), lane_law(lmp), level(lmp), bodies(lmp), watch(lmp), checks(lmp) {}
  ContactObserver observer;
  ContactReader reader;
  grainscope::LaneLaw lane_law;
  grainscope::TimeLevel level;
  grainscope::EllipsoidBodies bodies;
  grainscope::EllipsoidSurface surface;
  grainscope::TimeStepWatch watch;
  grainscope::PairChecks checks;
  std::unique_ptr<LIGGGHTS::PairStyles::IGranularPairStyle> loop;
  double **friction = nullptr;
  int past_column = -1;  // first of the ledger's columns of the contact history, or -1
  std::string models;    // the words of the command, for messages
  bool ledger = false;
  bool neutral = false;
  std::weak_ptr<grainscope::EvaluationMemory> memory;
  std::string sphere_model;  // that is given grains which may be no spheres, or ""
  /** To ghosts. */
  enum class Sent { of_host, images, masks } sent = Sent::of_host;
  void send(Sent what, PairGranInsitu &pair) {
    sent = what;
    pair.comm->forward_comm_pair(&pair);
    sent = Sent::of_host;
  }
  std::pair<bigint, bigint> run{-1, -1};  // first and last step of the run that the masks of ghosts are known to fit
  /** Groups may change before a run without set-up, `pre no`, and LIGGGHTS tells ghosts with the next neighbour list.
   *  What is frozen stays as the contact loop knows it. */
  void update_masks(PairGranInsitu &pair) {
    const std::pair<bigint, bigint> now{pair.update->firststep, pair.update->laststep};
    if (now == run) return;
    run = now;
    send(Sent::masks, pair);
  }
  bigint grains = 0;                            // in the last evaluation
  bool renumbered = false;                      // since then
  grainscope::NeighbourListWatch images_watch;  // of the image shifts of ghosts
};

PairGranInsitu::PairGranInsitu(LAMMPS *lmp) : PairGranProxy(lmp), impl_(new Impl(lmp)) {
  comm_forward = 3;  // the image shifts of ghosts
}

PairGranInsitu::~PairGranInsitu() {
  TangentialBound::get().set(TangentialBound::Mode::off);
  grainscope::run_fixes::remove(lmp);
  grainscope::stop_signal::release();
}

const std::string &PairGranInsitu::models() const { return impl_->models; }

ContactObserver &PairGranInsitu::observer() { return impl_->observer; }

ContactReader &PairGranInsitu::reader() { return impl_->reader; }

grainscope::LaneLaw &PairGranInsitu::lane_law() { return impl_->lane_law; }

grainscope::TimeLevel &PairGranInsitu::time_level() { return impl_->level; }

const ContactLaw &PairGranInsitu::law() const { return impl_->reader.law(); }

bool PairGranInsitu::keeps_past() const { return impl_->ledger; }

std::shared_ptr<grainscope::EvaluationMemory> PairGranInsitu::evaluation_memory() const { return impl_->memory.lock(); }

bool PairGranInsitu::renumbered() const { return impl_->renumbered; }

grainscope::EllipsoidBodies &PairGranInsitu::ellipsoid_bodies() { return impl_->bodies; }

grainscope::EllipsoidSurface &PairGranInsitu::ellipsoid_surface() { return impl_->surface; }

PairGranInsitu *PairGranInsitu::required_by(LAMMPS *lmp, const char *who) {
  PairGranInsitu *pair = dynamic_cast<PairGranInsitu *>(lmp->force->pair);
  if (!pair) {
    const std::string message = std::string(who) + " requires pair_style gran/insitu, got '" +
                                (lmp->force->pair ? lmp->force->pair_style : "no pair style") + "'";
    lmp->error->all(FLERR, message.c_str());
  }
  if (lmp->force->newton_pair)
    lmp->error->all(FLERR, (std::string(who) + " requires 'newton off', got 'newton on'").c_str());
  return pair;
}

void PairGranInsitu::settings(int narg, char **arg) {
  std::vector<char *> words(arg, arg + narg);
  const auto take = [&](const char *keyword, const char *no, const char *yes) {
    return grainscope::take_setting(lmp, "pair_style gran/insitu", words, keyword, no, yes);
  };
  impl_->ledger = take("ledger", "off", "on");
  impl_->neutral = take("setup", "host", "neutral");
  const bool synchronized = take("time_level", "host", "synchronized");
  if (force->pair != this)
    error->all(
        FLERR,
        "pair_style gran/insitu cannot be a sub-style of hybrid: contact history works with one granular style only; "
        "use it alone");
  narg = words.size();
  arg = words.data();
  std::string received;
  for (int k = 0; k < narg; k++) received += std::string(k ? " " : "") + arg[k];
  impl_->models = received;
  const int64_t hash =
      LIGGGHTS::PairStyles::Factory::instance().selectVariant("gran", narg, arg, force->custom_contact_models);
  if (hash == -1)
    error->all(
        FLERR,
        ("pair_style gran/insitu: invalid contact model (check for typos, and enable at least one model), got '" +
         received + "'")
            .c_str());
  history_arg.clear();
  impl_->past_column = -1;
  dnum_pairgran = 0;
  impl_->loop.reset(grainscope::create_observed_loop(hash, lmp, this));
  impl_->loop->settings(narg, arg, this);
  impl_->level.set(false, {}, false);
  if (synchronized) synchronize();
  if (impl_->ledger) add_past_columns();

  grainscope::stop_signal::watch();

  // fix contacthistory and fix check/timestep/gran look for a style of exactly this name; restart files carry it too.
  delete[] force->pair_style;
  force->pair_style = new char[5];
  strcpy(force->pair_style, "gran");
}

/** Once the models are made. */
void PairGranInsitu::synchronize() {
  const ContactLaw law = law_of_models();
  const std::string why = grainscope::TimeLevel::why_not(law);
  if (!why.empty())
    error->all(FLERR,
               ("pair_style gran/insitu: 'time_level synchronized' " + why + ", got '" + impl_->models + "'").c_str());
  const bool points = !contact_match("surface", "default");
  grainscope::TimeLevel::Columns columns;
  if (law.tangential == TangentialLaw::spring) columns.spring = column_of("shearx");
  if (points) {
    columns.kept = history_arg.size();
    grainscope::TimeLevel::add_columns(*this);
  }
  impl_->level.set(true, columns, points);
}

ContactLaw PairGranInsitu::law_of_models() {
  return grainscope::law_of_models(impl_->models,
                                   [this](const char *kind, const char *name) { return contact_match(kind, name); });
}

void PairGranInsitu::add_past_columns() {
  impl_->past_column = history_arg.size();
  for (int k = 0; k < ContactReader::past_columns; k++) add_history_value(ContactReader::past_column(k), "0");
  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out)
      fprintf(out,
              "pair_style gran/insitu: 'ledger on' keeps %d more numbers for every pair of neighbours (%d instead of "
              "%d); restart files with and without them are not interchangeable\n",
              ContactReader::past_columns, dnum_pairgran, dnum_pairgran - ContactReader::past_columns);
}

void PairGranInsitu::init_style() {
  impl_->checks.require_consistent_units();
  impl_->run = {update->firststep, update->laststep};
  impl_->observer.remove_all();
  impl_->observer.begin_run();
  impl_->images_watch = grainscope::NeighbourListWatch();
  if (history && !fix_history)
    impl_->checks.require_same_columns_in_restart(
        columns_in_restart(),
        {{"ledger", "on", "off", ContactReader::past_columns, impl_->ledger},
         {"time_level", "synchronized", "host",
          contact_match("surface", "default") ? 0 : grainscope::TimeLevel::kept_columns, impl_->level.kept() >= 0}});
  impl_->checks.warn_of_lost_states();
  impl_->renumbered = atom->natoms < impl_->grains && !grainscope::contacts_know_their_grains(lmp);
  if (impl_->renumbered && comm->me == 0)
    error->warning(FLERR, "grains got new IDs, and LIGGGHTS keeps tangential springs by ID: some springs now belong to "
                          "other contacts. Use 'delete_atoms ... compress no'");
  const std::string words = impl_->models + (impl_->ledger ? " ledger on" : "") +
                            (impl_->level.synchronized() ? " time_level synchronized" : "");
  grainscope::require_surface_models(lmp, this, words + (impl_->neutral ? " setup neutral" : ""));
  PairGranProxy::init_style();
  grainscope::run_fixes::make_guard(lmp, words);
  if (impl_->neutral) impl_->memory = grainscope::run_fixes::make_setup_memory(lmp);
  const auto *loop = dynamic_cast<grainscope::ResetsOpenedSprings *>(impl_->loop.get());
  if (law().tangential == TangentialLaw::spring && !(loop && loop->resets_springs()))
    impl_->checks.warn_of_stale_springs();
  impl_->checks.warn_of_unseen_walls();
  watch_time_step();
}

void PairGranInsitu::init_granular() {
  impl_->loop->init_granular();
  ContactLaw law = law_of_models();
  law.exponent = stressStrainExponent();
  law.past_column = impl_->past_column;
  law.synchronized = impl_->level.synchronized();
  if (law.tangential == TangentialLaw::spring) law.spring_column = column_of("shearx");
  const int place = contact_match("surface", "ellipsoid") ? grainscope::EllipsoidSurface::lambda + 1 : 0;
  impl_->lane_law.connect(impl_->models, law.spring_column == place);
  if (impl_->level.synchronized())
    impl_->lane_law.synchronize(impl_->level.kept() - grainscope::EllipsoidSurface::lambda);
  impl_->friction = nullptr;
  if (law.tangential == TangentialLaw::viscous || law.tangential == TangentialLaw::spring) {
    force->registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    force->registry.connect("coeffFrict", impl_->friction, "pair_style gran/insitu");
  }
  law.friction = impl_->friction;
  impl_->reader.set_law(law);
  impl_->observer.set_keeps_past(law.keeps_past());
  impl_->sphere_model = contact_match("surface", "superquadric") ? grainscope::SphereGeometry::of(*this) : "";
}

/** Numbers per contact. */
int PairGranInsitu::columns_in_restart() const {
  const bool ellipsoids = impl_->loop->contact_match("surface", "ellipsoid");
  return dnum_pairgran + (ellipsoids ? grainscope::SuperquadricColumns::left_out : 0);
}

/** Of the contact history. */
int PairGranInsitu::column_of(const std::string &name) const {
  for (std::size_t k = 0; k < history_arg.size(); k++)
    if (history_arg[k].name == name) return static_cast<int>(k);
  error->all(FLERR, ("pair_style gran/insitu: the contact history must have a column '" + name +
                     "' for the tangential spring, got '" + impl_->models + "'")
                        .c_str());
  return -1;
}

void PairGranInsitu::watch_time_step() {
  if (!law().elastic || !atom->rmass) return;
  impl_->watch.begin_run();
  impl_->observer.add(&impl_->watch);
}

void PairGranInsitu::compute(int eflag, int vflag) {
  if (neighbor->ago == 0 && history) impl_->checks.require_box_large_enough();
  if (neighbor->ago == 0) {
    impl_->checks.require_grains_in_plane();
    impl_->checks.warn_of_sphere_model(impl_->sphere_model);
  }
  impl_->update_masks(*this);
  const std::shared_ptr<grainscope::EvaluationMemory> memory = evaluation_memory();
  const bool repeats = memory && update->setupflag && memory->repeats();
  if (repeats) {
    memory->swap();
    impl_->observer.resume(memory->stamp());
  }
  {
    const grainscope::KeptHistory kept(repeats ? listgranhistory : nullptr, list, dnum());
    if (impl_->observer.begin(!update->setupflag, repeats)) update_image_shifts();
    set_tangential_bound();
    impl_->level.set_repeats(repeats && memory->repeats_a_step());
    PairGran::compute(eflag, vflag);
    impl_->level.set_repeats(false);
    impl_->observer.end();
  }
  if (repeats) memory->swap();
  impl_->grains = atom->natoms;
  if (memory) memory->set_stamp(impl_->observer.stamp());
}

/** In first evaluations, and for the walls that follow. */
void PairGranInsitu::set_tangential_bound() {
  using Mode = TangentialBound::Mode;
  const bool first = update->setupflag && impl_->observer.first_evaluation();
  TangentialBound::get().set(!first ? Mode::off : impl_->neutral ? Mode::bound : Mode::watch);
}

/** LIGGGHTS re-evaluates all contacts for compute pair/gran/local, and its surface model writes to the contact history
 *  then. */
void PairGranInsitu::compute_pgl(int eflag, int vflag) {
  const grainscope::KeptHistory kept(listgranhistory, list, dnum());
  PairGran::compute_pgl(eflag, vflag);
}

void PairGranInsitu::compute_force(int eflag, int vflag, int addflag) {
  impl_->loop->compute_force(this, eflag, vflag, addflag);
}

void PairGranInsitu::write_restart_settings(FILE *file) { impl_->loop->write_restart_settings(file); }

void PairGranInsitu::read_restart_settings(FILE *, const int, const int) {
  error->all(FLERR, "restart files name this style 'gran': re-issue pair_style gran/insitu after read_restart");
}

int PairGranInsitu::get_history_offset(const std::string name) { return impl_->loop->get_history_offset(name); }
double PairGranInsitu::stressStrainExponent() { return impl_->loop->stressStrainExponent(); }
int64_t PairGranInsitu::hashcode() { return impl_->loop->hashcode(); }
bool PairGranInsitu::contact_match(const std::string kind, const std::string model) {
  return impl_->loop->contact_match(kind, model);
}

/** The periodic image of each ghost, in whole box edges. The swaps know it exactly; positions do not, because grains
 *  drift out of the box between two neighbour lists. Once per neighbour list that is observed. */
void PairGranInsitu::update_image_shifts() {
  if (!impl_->images_watch.renewed(*neighbor, *update)) return;
  impl_->observer.image_shifts().assign(3 * (atom->nlocal + atom->nghost), 0.0);
  impl_->send(Impl::Sent::images, *this);
}

int PairGranInsitu::pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) {
  switch (impl_->sent) {
    case Impl::Sent::of_host: break;
    case Impl::Sent::images:
      for (int k = 0; k < n; k++)
        for (int d = 0; d < 3; d++)
          buf[3 * k + d] = impl_->observer.image_shifts()[3 * list[k] + d] + (pbc_flag ? pbc[d] : 0);
      return 3;
    case Impl::Sent::masks:
      for (int k = 0; k < n; k++) buf[k] = atom->mask[list[k]];
      return 1;
  }
  return PairGran::pack_comm(n, list, buf, pbc_flag, pbc);
}

void PairGranInsitu::unpack_comm(int n, int first, double *buf) {
  switch (impl_->sent) {
    case Impl::Sent::of_host: break;
    case Impl::Sent::images: std::copy(buf, buf + 3 * n, impl_->observer.image_shifts().begin() + 3 * first); return;
    case Impl::Sent::masks: {
      const int frozen = freeze_group_bit();
      for (int k = 0; k < n; k++) {
        int &mask = atom->mask[first + k];
        mask = (static_cast<int>(buf[k]) & ~frozen) | (mask & frozen);
      }
      return;
    }
  }
  PairGran::unpack_comm(n, first, buf);
}
