// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_setup_memory.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>

using namespace LAMMPS_NS;

namespace {

char memory_id[] = "gran_insitu_setup", group_all[] = "all", memory_style[] = "setup/memory";
const double same_place = 1e-9;   // of the box: what the host's wrapping may change, and no command means

/** FNV-1a of the bits of numbers, as one that is a double without loss. */
class Hash {
 public:
  void add(const double *values, int n) {
    const unsigned char *bytes = reinterpret_cast<const unsigned char *>(values);
    for (std::size_t k = 0; k < n * sizeof(double); k++) h_ = (h_ ^ bytes[k]) * 1099511628211u;
  }
  void add(double value) { add(&value, 1); }
  double value() const { return static_cast<double>(h_ >> 11); }

 private:
  std::uint64_t h_ = 14695981039346656037u;
};

double velocity_hash_of(const Atom *atom, int i) {
  Hash hash;
  hash.add(atom->v[i], 3);
  return hash.value();
}

double state_hash_of(const Atom *atom, int i) {
  Hash hash;
  hash.add(atom->omega[i], 3);
  hash.add(atom->radius[i]);
  hash.add(atom->rmass[i]);
  hash.add(atom->type[i]);
  if (atom->superquadric_flag) {
    hash.add(atom->quaternion[i], 4);
    hash.add(atom->angmom[i], 3);
    hash.add(atom->shape[i], 3);
    hash.add(atom->blockiness[i], 2);
  }
  return hash.value();
}

void image_of(const Atom *atom, int i, int where[3]) {
  where[0] = (atom->image[i] & IMGMASK) - IMGMAX;
  where[1] = (atom->image[i] >> IMGBITS & IMGMASK) - IMGMAX;
  where[2] = (atom->image[i] >> IMG2BITS) - IMGMAX;
}

}

FixSetupMemory::FixSetupMemory(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (narg != 3 || strcmp(id, memory_id) != 0) error->all(FLERR, "fix setup/memory: is made by pair_style gran/insitu, not by an input script");
  restart_global = restart_peratom = create_attribute = force_reneighbor = 1;
  next_reneighbor = -1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSetupMemory::~FixSetupMemory() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
}

FixSetupMemory *FixSetupMemory::make(LAMMPS *lmp) {
  Modify *modify = lmp->modify;
  const auto find = [modify] {
    const int found = modify->find_fix(memory_id);
    return found < 0 ? nullptr : dynamic_cast<FixSetupMemory *>(modify->fix[found]);
  };
  char *words[] = {memory_id, group_all, memory_style};
  FixSetupMemory *memory = find();
  if (memory && modify->fix[modify->nfix - 1] == memory) return memory;
  if (memory) {  // to the end of the list
    const std::vector<double> values = memory->values_;
    double box[edges];
    std::copy(memory->box_, memory->box_ + edges, box);
    const double grains = memory->grains_, stamp = memory->stamp_;
    modify->delete_fix(memory_id);
    modify->add_fix(3, words);
    memory = find();
    memory->just_created = 0;  // the host would give it empty arrays
    memory->values_ = values;
    std::copy(box, box + edges, memory->box_);
    memory->grains_ = grains;
    memory->stamp_ = stamp;
    return memory;
  }
  if (modify->find_fix(memory_id) >= 0)
    lmp->error->all(FLERR, (std::string("pair_style gran/insitu needs the fix ID '") + memory_id + "', but it is taken").c_str());
  modify->add_fix(3, words);
  return find();
}

void FixSetupMemory::forget(LAMMPS *lmp) {
  if (lmp->modify && lmp->modify->nfix && lmp->modify->find_fix(memory_id) >= 0) lmp->modify->delete_fix(memory_id);
}

int FixSetupMemory::setmask() { return FixConst::PRE_FORCE; }

void FixSetupMemory::init() {
  running_ = again_ = false;
  next_reneighbor = -1;
}

void FixSetupMemory::box_now(double box[edges]) const {
  std::copy(domain->h, domain->h + 6, box);
  std::copy(domain->boxlo, domain->boxlo + 3, box + 6);
}

/** Velocities of a grain that was wrapped across faces, as the host changes v. */
void FixSetupMemory::carry_across(int i, const int crossed[3]) {
  if (!domain->deform_vremap || !(atom->mask[i] & domain->deform_groupbit)) return;
  const double *rate = domain->h_rate;
  double *v = of(i) + half_v;
  v[0] -= crossed[0] * rate[0];
  v[0] -= crossed[1] * rate[5];
  v[1] -= crossed[1] * rate[1];
  v[0] -= crossed[2] * rate[4];
  v[1] -= crossed[2] * rate[3];
  v[2] -= crossed[2] * rate[2];
}

/** Whether grain i is as it was at the end of the last run; a grain that was wrapped since has its velocities carried along. */
bool FixSetupMemory::same(int i) {
  double *mine = of(i);
  if (mine[known] != 1.0 || mine[state_hash] != state_hash_of(atom, i)) return false;
  tagint then;
  std::memcpy(&then, &mine[image], sizeof then);
  double shift[3] = {atom->x[i][0] - mine[x], atom->x[i][1] - mine[x + 1], atom->x[i][2] - mine[x + 2]};
  if (then == atom->image[i]) {
    if (mine[velocity_hash] != velocity_hash_of(atom, i)) return false;
  } else {
    const tagint now = atom->image[i];
    int before[3], after[3], crossed[3];
    image_of(atom, i, after);
    atom->image[i] = then;
    image_of(atom, i, before);
    atom->image[i] = now;
    for (int k = 0; k < 3; k++) crossed[k] = after[k] - before[k];
    shift[0] += crossed[0] * domain->xprd + crossed[1] * domain->xy + crossed[2] * domain->xz;
    shift[1] += crossed[1] * domain->yprd + crossed[2] * domain->yz;
    shift[2] += crossed[2] * domain->zprd;
    carry_across(i, crossed);
    std::memcpy(&mine[image], &now, sizeof now);
    for (int k = 0; k < 3; k++) mine[x + k] = atom->x[i][k];
    mine[velocity_hash] = velocity_hash_of(atom, i);
  }
  const double *size = domain->prd;
  for (int k = 0; k < 3; k++)
    if (!(std::fabs(shift[k]) <= same_place * size[k])) return false;
  return true;
}

/** Collective. */
bool FixSetupMemory::unchanged() {
  double box[edges];
  box_now(box);
  int changed = grains_ != static_cast<double>(atom->natoms) || !std::equal(box, box + edges, box_);
  for (int i = 0; i < atom->nlocal && !changed; i++) changed = !same(i);
  const bool nothing = grains_ < 0.0;
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, world);
  if (changed && !nothing && comm->me == 0)
    for (FILE *out : {screen, logfile})
      if (out) fprintf(out, "pair_style gran/insitu: grains or box were changed since the last run: forces are formed anew, as with 'setup host'\n");
  return !changed;
}

void FixSetupMemory::swap_velocities() {
  for (int i = 0; i < atom->nlocal; i++) {
    std::swap_ranges(atom->v[i], atom->v[i] + 3, of(i) + half_v);
    std::swap_ranges(atom->omega[i], atom->omega[i] + 3, of(i) + half_omega);
  }
  comm->forward_comm();
}

void FixSetupMemory::setup_pre_force(int) {
  again_ = unchanged();
  if (again_) {
    for (int i = 0; i < atom->nlocal; i++) std::copy(of(i) + x, of(i) + x + 3, atom->x[i]);  // wrapping cost a few bits
    next_reneighbor = update->ntimestep + 1;
    return;
  }
  for (int i = 0; i < atom->nlocal; i++) take_velocities(i);
}

void FixSetupMemory::setup(int) {
  running_ = true;
  if (!again_) return;
  again_ = false;
  for (int i = 0; i < atom->nlocal; i++) {
    std::copy(of(i) + f, of(i) + f + 3, atom->f[i]);
    std::copy(of(i) + torque, of(i) + torque + 3, atom->torque[i]);
  }
}

void FixSetupMemory::take_velocities(int i) {
  std::copy(atom->v[i], atom->v[i] + 3, of(i) + half_v);
  std::copy(atom->omega[i], atom->omega[i] + 3, of(i) + half_omega);
}

void FixSetupMemory::pre_force(int) {
  for (int i = 0; i < atom->nlocal; i++) take_velocities(i);
}

/** Everything but the velocities of the evaluation, which must be told at its time. */
void FixSetupMemory::take_rest() {
  grains_ = atom->natoms;
  box_now(box_);
  for (int i = 0; i < atom->nlocal; i++) {
    double *mine = of(i);
    mine[known] = 1.0;
    std::copy(atom->f[i], atom->f[i] + 3, mine + f);
    std::copy(atom->torque[i], atom->torque[i] + 3, mine + torque);
    std::copy(atom->x[i], atom->x[i] + 3, mine + x);
    mine[image] = 0.0;
    std::memcpy(&mine[image], &atom->image[i], sizeof atom->image[i]);
    mine[velocity_hash] = velocity_hash_of(atom, i);
    mine[state_hash] = state_hash_of(atom, i);
  }
}

void FixSetupMemory::post_run() {
  take_rest();
  running_ = false;
}

/** Grains that the box has moved past are wrapped, as the run that begins from the file will do. */
void FixSetupMemory::wrap_now() {
  const int n = atom->nlocal;
  std::vector<double> places(atom->x[0], atom->x[0] + 3 * n);
  std::vector<tagint> images(atom->image, atom->image + n);
  if (domain->triclinic) domain->x2lamda(n);
  domain->pbc();
  if (domain->triclinic) domain->lamda2x(n);
  for (int i = 0; i < n; i++) {
    if (atom->image[i] == images[i]) {
      std::copy(&places[3 * i], &places[3 * i] + 3, atom->x[i]);
      continue;
    }
    int after[3], before[3];
    image_of(atom, i, after);
    std::swap(atom->image[i], images[i]);
    image_of(atom, i, before);
    std::swap(atom->image[i], images[i]);
    const int crossed[3] = {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
    carry_across(i, crossed);
  }
}

void FixSetupMemory::grow_arrays(int nmax) { values_.resize(static_cast<std::size_t>(nmax) * width, 0.0); }
void FixSetupMemory::copy_arrays(int from, int to, int) { std::copy(of(from), of(from) + width, of(to)); }
void FixSetupMemory::set_arrays(int i) { std::fill(of(i), of(i) + width, 0.0); }

int FixSetupMemory::pack_exchange(int i, double *buffer) {
  std::copy(of(i), of(i) + width, buffer);
  return width;
}

int FixSetupMemory::unpack_exchange(int i, double *buffer) {
  std::copy(buffer, buffer + width, of(i));
  return width;
}

int FixSetupMemory::pack_restart(int i, double *buffer) {
  buffer[0] = width + 1;
  std::copy(of(i), of(i) + width, buffer + 1);
  return width + 1;
}

void FixSetupMemory::unpack_restart(int i, int nth) {
  const double *extra = atom->extra[i];
  for (int k = 0; k < nth; k++) extra += static_cast<int>(extra[0]);
  std::copy(extra + 1, extra + 1 + width, of(i));
}

/** Comes before the grains are written. */
void FixSetupMemory::write_restart(FILE *file) {
  if (running_) {
    if (atom->nlocal) wrap_now();
    take_rest();
    next_reneighbor = update->ntimestep + 1;  // the run that begins from the file has new lists then, too
  }
  if (comm->me != 0) return;
  double state[edges + 2];
  std::copy(box_, box_ + edges, state);
  state[edges] = grains_;
  state[edges + 1] = stamp_;
  const int size = sizeof state;
  fwrite(&size, sizeof size, 1, file);
  fwrite(state, 1, size, file);
}

void FixSetupMemory::restart(char *buffer) {
  double state[edges + 2];
  memcpy(state, buffer, sizeof state);
  std::copy(state, state + edges, box_);
  grains_ = state[edges];
  stamp_ = state[edges + 1];
}
