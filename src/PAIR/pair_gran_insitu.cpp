// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_insitu.h"
#include "bin_index.h"
#include "contact_ids.h"
#include "contact_observer.h"
#include "ellipsoid_surface.h"
#include "gran_insitu_models.h"
#include "kept_history.h"
#include "run_fixes.h"
#include "sphere_geometry.h"
#include "stop_signal.h"
#include "surface_required.h"
#include "symmetry_axis.h"
#include "tangential_bound.h"
#include "time_step_watch.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "global_properties.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"
#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using grainscope::BoxState;
using grainscope::ContactObserver;
using grainscope::TangentialBound;

struct PairGranInsitu::Impl {
  explicit Impl(LAMMPS *lmp) : observer(lmp), bodies(lmp), watch(lmp) {}
  ContactObserver observer;
  grainscope::EllipsoidBodies bodies;
  grainscope::EllipsoidSurface surface;
  grainscope::TimeStepWatch watch;
  std::unique_ptr<LIGGGHTS::PairStyles::IGranularPairStyle> loop;
  double **friction = nullptr;
  std::string models;              // the words of the command, for messages
  bool ledger = false;
  bool neutral = false;
  std::weak_ptr<grainscope::EvaluationMemory> memory;
  bool warned_of_stale_springs = false;
  std::string sphere_model;        // that is given grains which may be no spheres, or ""
  bool warned_of_sphere_model = false;
  bool sending_images = false;
  bigint grains = 0;               // in the last evaluation
  bool renumbered = false;         // since then
  bigint images_of_build = -1;
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
  if (lmp->force->newton_pair) lmp->error->all(FLERR, (std::string(who) + " requires 'newton off', got 'newton on'").c_str());
  return pair;
}

void PairGranInsitu::settings(int narg, char **arg) {
  std::vector<char *> words(arg, arg + narg);
  impl_->ledger = take_setting(words, "ledger", "off", "on");
  impl_->neutral = take_setting(words, "setup", "host", "neutral");
  if (force->pair != this)
    error->all(FLERR, "pair_style gran/insitu cannot be a sub-style of hybrid: contact history works with one granular style only; "
                      "use it alone");
  narg = words.size();
  arg = words.data();
  std::string received;
  for (int k = 0; k < narg; k++) received += std::string(k ? " " : "") + arg[k];
  impl_->models = received;
  const int64_t hash = LIGGGHTS::PairStyles::Factory::instance().selectVariant("gran", narg, arg, force->custom_contact_models);
  if (hash == -1)
    error->all(FLERR, ("pair_style gran/insitu: invalid contact model (check for typos, and enable at least one model), got '" + received +
                       "'").c_str());
  history_arg.clear();
  impl_->observer.set_past(-1);
  dnum_pairgran = 0;
  impl_->loop.reset(grainscope::create_observed_loop(hash, lmp, this));
  impl_->loop->settings(narg, arg, this);
  if (impl_->ledger) add_past_columns();

  grainscope::stop_signal::watch();

  // fix contacthistory and fix check/timestep/gran look for a style of exactly this name; restart files carry it too.
  delete[] force->pair_style;
  force->pair_style = new char[5];
  strcpy(force->pair_style, "gran");
}

/** Takes `keyword no|yes` out of the words, which are otherwise the host's; whether it was yes. */
bool PairGranInsitu::take_setting(std::vector<char *> &words, const char *keyword, const char *no, const char *yes) {
  const auto is_keyword = [keyword](const char *word) { return !strcmp(word, keyword); };
  const auto at = std::find_if(words.begin(), words.end(), is_keyword);
  if (at == words.end()) return false;
  const bool ends = at + 1 == words.end();
  const std::string got = ends ? "" : at[1];
  const std::string about = std::string("pair_style gran/insitu: '") + keyword + "' ";
  if (got != no && got != yes) {
    const std::string told = ends ? "the end of the command" : "'" + got + "'";
    error->all(FLERR, (about + "must be " + yes + " or " + no + ", got " + told).c_str());
  }
  const auto next = words.erase(at, at + 2);
  if (std::any_of(next, words.end(), is_keyword)) error->all(FLERR, (about + "is given twice").c_str());
  return got == yes;
}

void PairGranInsitu::add_past_columns() {
  impl_->observer.set_past(history_arg.size());
  for (int k = 0; k < ContactObserver::past_columns; k++) add_history_value(ContactObserver::past_column(k), "0");
  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out)
      fprintf(out, "pair_style gran/insitu: 'ledger on' keeps %d numbers more for every pair of neighbours (%d instead of %d); restart files "
              "with and without them are not interchangeable\n", ContactObserver::past_columns, dnum_pairgran,
              dnum_pairgran - ContactObserver::past_columns);
}

namespace {

/** What a restart file holds for fixes that are not defined yet is the host's own matter: a derived class may look. */
struct RestartData : Modify {
  static const char *of(Modify *modify, const char *id) {
    for (int k = 0; k < modify->*(&RestartData::nfix_restart_global); k++)
      if (!strcmp((modify->*(&RestartData::id_restart_global))[k], id)) return (modify->*(&RestartData::state_restart_global))[k];
    return nullptr;
  }
};

}

/** The host would say no more than that the models differ. */
void PairGranInsitu::require_same_columns_in_restart() {
  if (!history || fix_history) return;
  const char *state = RestartData::of(modify, "contacthistory");
  if (!state) return;
  double columns[2];  // the host writes the number of columns, and one more
  memcpy(columns, state, sizeof columns);
  const int found = static_cast<int>(grainscope::whole_count(columns[0], 1e6)), wanted = dnum_pairgran;
  const int past = ContactObserver::past_columns;
  const std::string numbers = std::to_string(found) + " numbers per contact, and this pair_style has " + std::to_string(wanted) + ": ";
  if (found == wanted) return;
  if (found == wanted - past && impl_->ledger)
    error->all(FLERR, ("pair_style gran/insitu: the restart file holds " + numbers + "it was written without 'ledger on', so the ledger cannot "
                       "be continued from it. Say 'ledger off', or write the restart file with 'ledger on'").c_str());
  if (found == wanted + past && !impl_->ledger)
    error->all(FLERR, ("pair_style gran/insitu: the restart file holds " + numbers + "it was written with 'ledger on'. Say 'ledger on'").c_str());
}

void PairGranInsitu::init_style() {
  impl_->observer.remove_all();
  impl_->observer.begin_run();
  impl_->images_of_build = -1;
  require_same_columns_in_restart();
  impl_->renumbered = atom->natoms < impl_->grains && !grainscope::contacts_know_their_grains(lmp);
  if (impl_->renumbered && comm->me == 0)
    error->warning(FLERR, "grains were given other IDs, and the host keeps tangential springs by ID: some are now those of other contacts. Say "
                          "'compress no' to delete_atoms");
  const std::string ledger = impl_->ledger ? " ledger on" : "", setup = impl_->neutral ? " setup neutral" : "";
  grainscope::require_surface_models(lmp, this, impl_->models + ledger + setup);
  PairGranProxy::init_style();
  grainscope::run_fixes::make_guard(lmp, impl_->models + (impl_->ledger ? " ledger on" : ""));
  if (impl_->neutral) impl_->memory = grainscope::run_fixes::make_setup_memory(lmp);
  warn_of_stale_springs();
  watch_time_step();
}

void PairGranInsitu::init_granular() {
  using Law = ContactObserver::TangentialLaw;
  impl_->loop->init_granular();
  Law law = Law::other;
  if (contact_match("tangential", "off")) law = Law::off;
  else if (contact_match("tangential", "no_history")) law = Law::no_history;
  else if (contact_match("tangential", "history")) law = Law::history;
  int spring = 0;
  if (law == Law::history)
    while (history_arg[spring].name != "shearx") spring++;
  impl_->observer.set_law(law, spring);
  bool elastic = false;
  for (const char *model : {"hertz", "hooke", "hertz/stiffness", "hooke/stiffness"}) elastic = elastic || contact_match("normal", model);
  impl_->observer.set_elastic(elastic);
  impl_->observer.set_rolling(!contact_match("rolling_friction", "off"));
  impl_->observer.set_limits_force(impl_->models.find("limitForce on") != std::string::npos);
  impl_->observer.set_wet(contact_match("cohesion", "washino/capillary/viscous") ||
                          contact_match("cohesion", "easo/capillary/viscous"));
  impl_->sphere_model = contact_match("surface", "superquadric") ? grainscope::SphereGeometry::of(*this) : "";

  impl_->friction = nullptr;
  if (law == Law::no_history || law == Law::history) {
    force->registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    force->registry.connect("coeffFrict", impl_->friction, "pair_style gran/insitu");
  }
  impl_->observer.set_friction(impl_->friction);
}

void PairGranInsitu::warn_of_stale_springs() {
  if (impl_->warned_of_stale_springs || impl_->observer.law() != ContactObserver::TangentialLaw::history) return;
  if (neighbor->contactDistanceFactor > 1.0 || dynamic_cast<grainscope::ResetsOpenedSprings *>(impl_->loop.get())) return;
  int spheres = atom->sphere_flag;
  if (atom->superquadric_flag)
    for (int i = 0; i < atom->nlocal && !spheres; i++)
      spheres = atom->shape[i][0] == atom->shape[i][1] && atom->shape[i][1] == atom->shape[i][2];
  int any = 0;
  MPI_Allreduce(&spheres, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  impl_->warned_of_stale_springs = true;
  if (comm->me == 0)
    error->warning(FLERR, "spheres at contact distance factor 1.0 keep the tangential spring of a contact that has opened, until the "
                          "next neighbour list: add the line 'neigh_modify contact_distance_factor 1.05'");
}

/** Once, when there are such grains. */
void PairGranInsitu::warn_of_sphere_model() {
  if (impl_->sphere_model.empty() || impl_->warned_of_sphere_model) return;
  int any = 0;
  using grainscope::Shape;
  for (int i = 0; i < atom->nlocal && !any; i++) any = grainscope::symmetry_axis(atom->shape[i]).shape != Shape::sphere;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  const std::string message = "pair_style gran/insitu: '" + impl_->sphere_model + "' takes its geometry from the "
      "distance of centres and the radii of spheres: with surface superquadric its forces on grains that are no "
      "spheres are wrong. Say 'surface ellipsoid', which gives sjkr and sjkr2 the contact's own overlap and effective radius";
  if (comm->me == 0) error->warning(FLERR, message.c_str());
  impl_->warned_of_sphere_model = true;
}

void PairGranInsitu::watch_time_step() {
  if (!impl_->observer.elastic() || !atom->rmass) return;
  using Law = ContactObserver::TangentialLaw;
  const Law law = impl_->observer.law();
  impl_->watch.begin_run(stressStrainExponent(), law == Law::history || law == Law::other);
  impl_->observer.add(&impl_->watch);
}

/** Contact history is keyed by grain ID: with two images of one grain within reach of another it is ambiguous. */
void PairGranInsitu::require_box_large_enough() {
  const BoxState box(lmp);
  const double needed = 2.0 * neighbor->cutneighmax;
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; k++)
    if (periodic[k] && box.height(k) < needed) {
      char message[256];
      snprintf(message, sizeof message, "pair_style gran/insitu: the periodic box must be at least 2 x (largest diameter x contact distance "
               "factor + skin) = %g high along %c, got %g: two images of one grain could touch the same neighbour", needed, "xyz"[k], box.height(k));
      error->all(FLERR, message);
    }
}

void PairGranInsitu::compute(int eflag, int vflag) {
  if (neighbor->ago == 0 && history) require_box_large_enough();
  if (neighbor->ago == 0) warn_of_sphere_model();
  const std::shared_ptr<grainscope::EvaluationMemory> memory = impl_->memory.lock();
  const bool repeats = memory && update->setupflag && memory->repeats();
  if (repeats) {
    memory->swap();
    impl_->observer.resume(memory->stamp());
  }
  {
    const grainscope::KeptHistory kept(repeats ? listgranhistory : nullptr, list, dnum());
    if (impl_->observer.begin(!update->setupflag, repeats)) update_image_shifts();
    set_tangential_bound();
    PairGran::compute(eflag, vflag);
    impl_->observer.end();
  }
  if (repeats) memory->swap();
  impl_->grains = atom->natoms;
  if (memory) memory->set_stamp(impl_->observer.stamp());
  impl_->watch.judge();
}

/** In first evaluations, and for the walls that follow. */
void PairGranInsitu::set_tangential_bound() {
  using Mode = TangentialBound::Mode;
  const bool first = update->setupflag && impl_->observer.first_evaluation();
  TangentialBound::get().set(!first ? Mode::off : impl_->neutral ? Mode::bound : Mode::watch);
}

/** The host re-evaluates all contacts for compute pair/gran/local, and its surface model writes to the contact history while at it. */
void PairGranInsitu::compute_pgl(int eflag, int vflag) {
  const grainscope::KeptHistory kept(listgranhistory, list, dnum());
  PairGran::compute_pgl(eflag, vflag);
}

void PairGranInsitu::compute_force(int eflag, int vflag, int addflag) { impl_->loop->compute_force(this, eflag, vflag, addflag); }

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

/** Which periodic image each ghost is, in whole box edges. The swaps know it exactly; positions do not, because grains drift out of
 *  the box between two neighbour lists. Once per neighbour list that is observed. */
void PairGranInsitu::update_image_shifts() {
  if (impl_->images_of_build == neighbor->lastcall) return;
  impl_->images_of_build = neighbor->lastcall;
  impl_->observer.image_shifts().assign(3 * (atom->nlocal + atom->nghost), 0.0);
  impl_->sending_images = true;
  comm->forward_comm_pair(this);
  impl_->sending_images = false;
}

int PairGranInsitu::pack_comm(int n, int *list, double *buf, int pbc_flag, int *pbc) {
  if (!impl_->sending_images) return PairGran::pack_comm(n, list, buf, pbc_flag, pbc);
  for (int k = 0; k < n; k++)
    for (int d = 0; d < 3; d++) buf[3 * k + d] = impl_->observer.image_shifts()[3 * list[k] + d] + (pbc_flag ? pbc[d] : 0);
  return 3;
}

void PairGranInsitu::unpack_comm(int n, int first, double *buf) {
  if (!impl_->sending_images) return PairGran::unpack_comm(n, first, buf);
  std::copy(buf, buf + 3 * n, impl_->observer.image_shifts().begin() + 3 * first);
}
