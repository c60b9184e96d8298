// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_insitu.h"
#include "arguments.h"
#include "bin_index.h"
#include "contact_observer.h"
#include "evaluation_memory.h"
#include "kept_wall_history.h"
#include "mesh_velocities.h"
#include "model_names.h"
#include "observed_wall.h"
#include "pair_gran_insitu.h"
#include "restart_data.h"
#include "restart_state.h"
#include "superquadric_columns.h"
#include "taken_setting.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_mesh_surface.h"
#include "force.h"
#include "global_properties.h"
#include "modify.h"
#include "tri_mesh.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <sstream>

using namespace LAMMPS_NS;
using grainscope::ContactLaw;
using grainscope::ContactReader;
using grainscope::RestartData;
using grainscope::TangentialLaw;
using LIGGGHTS::IContactHistorySetup;
using LIGGGHTS::Walls::Factory;
using LIGGGHTS::Walls::IGranularWall;

namespace {

/** Takes the place of the contact models of the wall while the constructor of the base class runs: the models call
 *  members of ours when they are made, and these do not exist yet. */
class Deferred : public IGranularWall {
 public:
  explicit Deferred(int64_t hash) : hash(hash) {}
  void settings(int n, char **words, IContactHistorySetup *) override { this->words.assign(words, words + n); }
  void init_granular() override {}
  bool checkSurfaceIntersect(LIGGGHTS::ContactModels::SurfacesIntersectData &) override { return false; }
  void compute_force(FixWallGran *, LIGGGHTS::ContactModels::SurfacesIntersectData &, bool, double *, FixMeshSurface *,
                     int, TriMesh *, int) override {}
  int get_history_offset(std::string) override { return -1; }
  bool contact_match(const std::string, const std::string) override { return false; }

  const int64_t hash;
  std::vector<char *> words;  // settings of the models
};

IGranularWall *create(LAMMPS *lmp, FixWallGran *wall, int64_t hash) {
  if (!strcmp(wall->style, "wall/gran")) return new Deferred(hash);
  return grainscope::create_observed_wall(hash, lmp, wall);
}

/** LIGGGHTS warns of every entry that is registered twice in its list of walls: here all of them are replaced. */
LAMMPS *take_over(LAMMPS *lmp) {
  static bool done = false;
  if (done) return lmp;
  done = true;
  std::streambuf *const errors = std::cerr.rdbuf(nullptr);
  for (int64_t hash : grainscope::observed_walls()) Factory::instance().addStyle("gran", hash, &create);
  std::cerr.rdbuf(errors);
  return lmp;
}

/** What follows `primitive type N` in the words of a command. */
std::vector<std::string> primitive_of(const std::string &words) {
  std::istringstream all(words);
  std::vector<std::string> found;
  for (std::string word; found.size() < 7 && all >> word;)
    if (word == "primitive" || !found.empty()) found.push_back(word);
  found.erase(found.begin(), found.begin() + std::min<std::size_t>(found.size(), 3));
  return found;
}

/** The words of the command behind the style, for messages and for what they say of the models. */
std::string words_of(int narg, char **arg) {
  std::string words;
  for (int k = 3; k < narg; k++) words += std::string(k > 3 ? " " : "") + arg[k];
  return words;
}

const double rounding = 1e-9;  // of a unit normal

/** In restart files, before the names of the columns of the contact history and the velocities of the meshes. */
struct SavedWall {
  static constexpr std::uint32_t version = 2;
  double letters;  // of the names
  double numbers;  // of MeshVelocities
};

/** What to do when a restart file has other columns. */
const char same_words[] =
    ": use the contact models, the 'time_level', and the 'ledger' of the pair style that it was written with";

}

struct FixWallGranInsitu::Impl : grainscope::WallContacts {
  explicit Impl(LAMMPS *lmp) : time_level(lmp), velocities(lmp) {}
  grainscope::TimeLevel time_level;
  std::string words;
  std::vector<std::string> columns;  // of the contact history
  int past_column = -1;              // first of the ledger's, or -1
  double **friction = nullptr;
  PairGranInsitu *pair = nullptr;
  std::unique_ptr<ContactReader> contacts;
  std::shared_ptr<void> takes_part;       // in the evaluations of the pair style
  grainscope::MeshVelocities velocities;  // with `setup neutral`
  bool keeps_velocities = false;          // of meshes that move or have moved
  bool kept = false;                      // they are of the last evaluation already, or of a restart file

  int column_of(const std::string &name) const {
    const auto at = std::find(columns.begin(), columns.end(), name);
    return at == columns.end() ? -1 : at - columns.begin();
  }
};

struct FixWallGranInsitu::Words {
  Words(LAMMPS *lmp, int narg, char **arg) : all(arg, arg + narg) {
    synchronized = grainscope::take_setting(lmp, "fix " + std::string(arg[0]) + " (wall/gran)", all, "time_level",
                                            "host", "synchronized");
  }
  std::vector<char *> all;  // of the command, without those of ours
  bool synchronized;
};

FixWallGranInsitu::FixWallGranInsitu(LAMMPS *lmp, int narg, char **arg)
    : FixWallGranInsitu(lmp, Words(lmp, narg, arg)) {}

FixWallGranInsitu::FixWallGranInsitu(LAMMPS *lmp, Words words)
    : FixWallGran(take_over(lmp), words.all.size(), words.all.data()), impl_(new Impl(lmp)) {
  restart_global = 1;
  impl_->words = words_of(words.all.size(), words.all.data());
  const std::unique_ptr<Deferred> deferred(dynamic_cast<Deferred *>(impl));
  impl = nullptr;  // until there is another: making it may end the run
  if (!deferred) error->fix_error(FLERR, this, "its contact models were not made by this program");
  impl = grainscope::create_observed_wall(deferred->hash, lmp, this);
  impl->settings(deferred->words.size(), deferred->words.data(), this);
  if (words.synchronized) synchronize();
  const PairGranInsitu *const pair = dynamic_cast<PairGranInsitu *>(force->pair);
  if (!pair || !pair->keeps_past()) return;
  impl_->past_column = impl_->columns.size();
  for (int k = 0; k < ContactReader::past_columns; k++) add_history_value(ContactReader::past_column(k), "0");
}

FixWallGranInsitu::~FixWallGranInsitu() {}

/** Once the models are made. */
void FixWallGranInsitu::synchronize() {
  const ContactLaw law = law_of_models();
  const std::string why = grainscope::TimeLevel::why_not(law);
  if (!why.empty())
    grainscope::end_run(lmp, who() + "'time_level synchronized' " + why + ", got '" + impl_->words + "'");
  grainscope::TimeLevel::Columns columns;
  columns.kept = impl_->columns.size();
  if (law.tangential == TangentialLaw::spring) columns.spring = impl_->column_of("shearx");
  grainscope::TimeLevel::add_columns(*this);
  impl_->time_level.set(true, columns, !contact_match("surface", "default"));
  impl_->level = &impl_->time_level;
}

std::string FixWallGranInsitu::who() const { return "fix " + std::string(id) + " (wall/gran): "; }

ContactLaw FixWallGranInsitu::law_of_models() {
  return grainscope::law_of_models(impl_->words,
                                   [this](const char *kind, const char *name) { return contact_match(kind, name); });
}

grainscope::WallContacts &FixWallGranInsitu::wall_contacts() { return *impl_; }

int FixWallGranInsitu::add_history_value(std::string name, std::string newtonflag) {
  impl_->columns.push_back(name);
  return FixWallGran::add_history_value(name, newtonflag);
}

std::vector<TriMesh *> FixWallGranInsitu::meshes() {
  std::vector<TriMesh *> meshes;
  meshes.reserve(n_meshes());
  for (int k = 0; k < n_meshes(); k++) meshes.push_back(mesh_list()[k]->triMesh());
  return meshes;
}

void FixWallGranInsitu::init() {
  FixWallGran::init();
  impl_->contacts.reset();
  impl_->takes_part.reset();
  impl_->keeps_velocities = false;
  impl_->pair = dynamic_cast<PairGranInsitu *>(force->pair);
  if (!impl_->pair) return;
  if (domain->dimension == 2) require_across_plane();
  ContactLaw law = law_of_models();
  law.exponent = impl_->exponent;
  if (impl_->pair->keeps_past() && impl_->past_column < 0)
    grainscope::end_run(lmp, who() + "must be defined after 'pair_style gran/insitu ... ledger on', which keeps more "
                                     "numbers for each contact, got it defined before");
  if (impl_->pair->keeps_past()) law.past_column = impl_->past_column;
  law.synchronized = impl_->level != nullptr;
  if (law.tangential == TangentialLaw::spring) law.spring_column = impl_->column_of("shearx");
  if (law.tangential == TangentialLaw::viscous || law.tangential == TangentialLaw::spring) {
    force->registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
    force->registry.connect("coeffFrict", impl_->friction, "fix wall/gran");
    law.friction = impl_->friction;
  }
  impl_->contacts.reset(new ContactReader(impl_->pair->observer()));
  impl_->contacts->set_law(law);
  impl_->takes_part = impl_->pair->observer().add_wall();
  impl_->keeps_velocities = keeps_velocities() && (is_moving() || !impl_->velocities.empty());
  std::vector<grainscope::Wall> before;
  for (int k = 0; k < modify->nfix && modify->fix[k] != this; k++)
    if (FixWallGranInsitu *wall = dynamic_cast<FixWallGranInsitu *>(modify->fix[k])) wall->add_to(before);
  impl_->first.wall = before.size();
  impl_->meshes.assign(mesh_list(), mesh_list() + n_meshes());
}

/** Errors unless the wall meets the grains of two dimensions in their plane. Collective. */
void FixWallGranInsitu::require_across_plane() {
  const grainscope::Arguments errors(lmp, "fix wall/gran " + std::string(id));
  if (!is_mesh_wall()) {
    const std::string kind = primitive_of(impl_->words).front();
    if (kind != "xplane" && kind != "yplane" && kind != "zcylinder")
      errors.fail("primitive", "xplane, yplane or zcylinder with 'dimension 2'", kind);
    return;
  }
  for (int m = 0; m < n_meshes(); m++) {
    TriMesh &mesh = *mesh_list()[m]->triMesh();
    int leans = 0;
    for (int k = 0; k < mesh.sizeLocal(); k++) {
      double normal[3];
      mesh.surfaceNorm(k, normal);
      if (std::fabs(normal[2]) > rounding) leans = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, &leans, 1, MPI_INT, MPI_MAX, world);
    if (leans)
      errors.fail("with 'dimension 2' the triangles of a mesh must be parallel to z, got others in mesh '" +
                  std::string(mesh_list()[m]->id) + "'");
  }
}

/** The forces of the first evaluation. If it repeats the last evaluation of the run before, it uses the positions and
 *  velocities of that one and leaves the contact history unchanged. */
void FixWallGranInsitu::setup(int vflag) {
  const std::shared_ptr<grainscope::EvaluationMemory> memory = impl_->pair ? impl_->pair->evaluation_memory() : nullptr;
  if (memory && memory->repeats()) {
    memory->swap();
    grainscope::MeshVelocities now(lmp);  // a mesh that no longer moves is at rest after this evaluation
    now.keep(meshes());
    impl_->velocities.restore(meshes());
    {
      const grainscope::KeptWallHistory kept(*this, fix_history_primitive_, atom->nlocal);
      impl_->time_level.set_repeats(memory->repeats_a_step());
      FixWallGran::setup(vflag);
      impl_->time_level.set_repeats(false);
    }
    now.restore(meshes());
    memory->swap();
  } else {
    if (keeps_velocities()) impl_->velocities.keep(meshes());
    FixWallGran::setup(vflag);
  }
  impl_->kept = keeps_velocities();  // a fix that moves a mesh and is set up later sets its velocity to zero
}

/** Before the next command, which may end the motion of a mesh. */
void FixWallGranInsitu::post_run() {
  FixWallGran::post_run();
  if (impl_->kept || !keeps_velocities()) return;
  impl_->velocities.keep(meshes());
  impl_->kept = true;
}

bool FixWallGranInsitu::keeps_velocities() { return is_mesh_wall() && impl_->pair && impl_->pair->evaluation_memory(); }

void FixWallGranInsitu::post_force(int vflag) {
  impl_->kept = false;
  if (!impl_->contacts) return FixWallGran::post_force(vflag);
  grainscope::ContactObserver &observer = impl_->pair->observer();
  observer.begin_wall();
  if (observer.active()) impl_->reader = impl_->contacts.get();
  FixWallGran::post_force(vflag);
  impl_->reader = nullptr;
  observer.end();
}

/** Either surface of superquadrics goes on with the numbers of the other: their names are those of superquadric. */
std::string FixWallGranInsitu::column_names() {
  const bool of_ellipsoid = contact_match("surface", "ellipsoid");
  std::string names;
  for (std::string name : impl_->columns) {
    if (of_ellipsoid && name == "touching") name = "particles_were_in_contact";
    if (of_ellipsoid && name == grainscope::SuperquadricColumns::kept) name = "a2";
    names += (names.empty() ? "" : " ") + name;
  }
  return names;
}

void FixWallGranInsitu::write_restart(FILE *file) {
  if (impl_->keeps_velocities && !impl_->kept) impl_->velocities.keep(meshes());
  if (comm->me != 0) return;
  const std::string names = column_names();
  const std::vector<double> &numbers = impl_->velocities.numbers();
  const SavedWall saved{static_cast<double>(names.size()), static_cast<double>(numbers.size())};
  std::vector<char> tail(names.begin(), names.end());
  const char *const first = reinterpret_cast<const char *>(numbers.data());
  tail.insert(tail.end(), first, first + numbers.size() * sizeof(double));
  grainscope::write_state(file, saved, tail.data(), tail.size());
}

/** Files of LIGGGHTS have no state of this fix, only how many numbers they hold for each contact. */
void FixWallGranInsitu::post_create_pre_restart() {
  if (RestartData::of(modify, id)) return;
  std::vector<std::string> histories;
  if (!is_mesh_wall()) histories.push_back("history_" + std::string(id));
  for (int k = 0; k < n_meshes(); k++) histories.push_back("tracker_" + std::string(mesh_list()[k]->id));
  for (const std::string &history : histories) {
    const char *const state = RestartData::of(modify, history);
    const int found = state ? grainscope::whole_count(RestartData::first_number(state), 1e6) : dnum();
    if (found != dnum())
      grainscope::end_run(lmp, who() + "the restart file holds " + std::to_string(found) +
                                   " numbers for each contact with this wall, this fix has " + std::to_string(dnum()) +
                                   same_words);
  }
}

void FixWallGranInsitu::restart(char *buffer) {
  const SavedWall saved = grainscope::read_state<SavedWall>(lmp, *this, style, buffer);
  const long long letters = grainscope::whole_count(saved.letters, 1e6),
                  n = grainscope::whole_count(saved.numbers, 1e9);
  if (letters < 0 || n < 0 || n % grainscope::MeshVelocities::width != 0)
    grainscope::end_run(lmp, who() + "the restart file must hold a whole number of mesh velocities, got " +
                                 std::to_string(saved.numbers));
  const char *const tail = grainscope::state_block::tail(buffer);
  const std::string written(tail, letters), names = column_names();
  if (written != names)
    grainscope::end_run(lmp, who() + "the restart file holds the numbers '" + written +
                                 "' for each contact with this wall, this fix has '" + names + "'" + same_words);
  if (n == 0) return;
  std::vector<double> numbers(static_cast<std::size_t>(n));
  memcpy(numbers.data(), tail + letters, numbers.size() * sizeof(double));
  impl_->velocities.set_numbers(numbers.data(), numbers.size());
  impl_->kept = true;
}

void FixWallGranInsitu::add_to(std::vector<grainscope::Wall> &walls) {
  const ContactLaw *const law = impl_->contacts ? &impl_->contacts->law() : nullptr;
  if (!is_mesh_wall()) walls.push_back({id, this, nullptr, law, primitive_of(impl_->words), fix_history_primitive_});
  for (int k = 0; is_mesh_wall() && k < n_meshes(); k++)
    walls.push_back({mesh_list()[k]->id, this, mesh_list()[k], law, {}, nullptr});
}

std::vector<grainscope::Wall> grainscope::walls_of(LAMMPS *lmp) {
  std::vector<Wall> walls;
  for (int k = 0; k < lmp->modify->nfix; k++)
    if (FixWallGranInsitu *fix = dynamic_cast<FixWallGranInsitu *>(lmp->modify->fix[k])) fix->add_to(walls);
  return walls;
}
