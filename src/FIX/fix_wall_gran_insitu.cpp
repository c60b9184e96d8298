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
#include "restart_state.h"
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

/** In restart files, before the velocities of the meshes. */
struct SavedWall {
  static constexpr std::uint32_t version = 1;
  double numbers;  // of MeshVelocities
};

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
  restart_global = 0;
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
  restart_global = keeps_velocities() && (is_moving() || !impl_->velocities.empty());
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

void FixWallGranInsitu::write_restart(FILE *file) {
  if (!impl_->kept) impl_->velocities.keep(meshes());
  const std::vector<double> &numbers = impl_->velocities.numbers();
  const SavedWall saved{static_cast<double>(numbers.size())};
  if (comm->me == 0) grainscope::write_state(file, saved, numbers.data(), numbers.size() * sizeof(double));
}

void FixWallGranInsitu::restart(char *buffer) {
  const SavedWall saved = grainscope::read_state<SavedWall>(lmp, *this, style, buffer);
  const long long n = grainscope::whole_count(saved.numbers, 1e9);
  if (n < 0 || n % grainscope::MeshVelocities::width != 0)
    error->all(FLERR, ("fix " + std::string(id) +
                       " (wall/gran): the restart file must hold a whole number of mesh velocities, got " +
                       std::to_string(saved.numbers))
                          .c_str());
  std::vector<double> numbers(static_cast<std::size_t>(n));
  memcpy(numbers.data(), grainscope::state_block::tail(buffer), numbers.size() * sizeof(double));
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
