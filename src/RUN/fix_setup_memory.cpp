// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_setup_memory.h"
#include "grain_state.h"
#include "restart_numbers.h"
#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

using namespace LAMMPS_NS;

namespace {

char memory_id[] = "gran_insitu_setup", group_all[] = "all", memory_style[] = "setup/memory";
// A line of an input script would replace what is remembered.
bool making = false;

const double same_place = 1e-9;   // of the box: what the host's wrapping may change, and no command means

tagint as_image(double slot) {
  tagint image;
  std::memcpy(&image, &slot, sizeof image);
  return image;
}

}

FixSetupMemory::FixSetupMemory(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (!making) error->all(FLERR, "fix setup/memory: is made by pair_style gran/insitu, not by an input script");
  restart_global = restart_peratom = create_attribute = force_reneighbor = 1;
  next_reneighbor = -1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixSetupMemory::~FixSetupMemory() {
  allow_sorting();
  if (place_) *place_ = nullptr;
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
  const auto add = [modify, find, &words] {
    making = true;
    modify->add_fix(3, words);
    making = false;
    FixSetupMemory *made = find();
    made->just_created = 0;  // the host would give it empty arrays
    return made;
  };
  FixSetupMemory *memory = find();
  if (memory && modify->fix[modify->nfix - 1] == memory) return memory;
  if (memory) {  // to the end of the list
    const std::vector<double> values = memory->values_;
    const Shared shared = memory->shared_;
    modify->delete_fix(memory_id);
    memory = add();
    memory->values_ = values;
    memory->shared_ = shared;
    return memory;
  }
  if (modify->find_fix(memory_id) >= 0)
    lmp->error->all(FLERR, (std::string("pair_style gran/insitu needs the fix ID '") + memory_id + "', but it is taken").c_str());
  return add();
}

void FixSetupMemory::forget(LAMMPS *lmp) {
  if (lmp->modify && lmp->modify->nfix && lmp->modify->find_fix(memory_id) >= 0) lmp->modify->delete_fix(memory_id);
}

int FixSetupMemory::setmask() { return FixConst::PRE_EXCHANGE | FixConst::PRE_FORCE; }

/** Grains in the order of their IDs, as none of the orders that the ranks may have them in is the same for a run that was taken up again. */
void FixSetupMemory::sort_by_tag() {
  const int n = atom->nlocal;
  if (n == atom->nmax) atom->avec->grow(0);
  std::vector<int> wanted(n);  // the k-th is to be the one that is now at wanted[k]
  std::iota(wanted.begin(), wanted.end(), 0);
  std::sort(wanted.begin(), wanted.end(), [this](int a, int b) { return atom->tag[a] < atom->tag[b]; });
  for (int first = 0; first < n; first++) {
    if (wanted[first] == first) continue;
    atom->avec->copy(first, n, 0);
    int hole = first;
    while (wanted[hole] != first) {
      atom->avec->copy(wanted[hole], hole, 0);
      hole = std::exchange(wanted[hole], hole);
    }
    atom->avec->copy(n, hole, 0);
    wanted[hole] = hole;
  }
}

/** In the step after a restart file: what the host does next too, but in an order that does not depend on the ranks' past. */
void FixSetupMemory::pre_exchange() {
  if (update->ntimestep != next_reneighbor) return;
  if (domain->triclinic) domain->x2lamda(atom->nlocal);
  domain->pbc();
  domain->reset_box();
  comm->setup();
  comm->exchange();
  sort_by_tag();
  if (domain->triclinic) domain->lamda2x(atom->nlocal);
}

void FixSetupMemory::init() {
  running_ = again_ = false;
  next_reneighbor = -1;
  allow_sorting();
}

/** The host sorts grains when a run begins, and sums forces in that order; a run that goes on does not sort then. */
void FixSetupMemory::setup_pre_exchange() {
  if (shared_.grains < 0.0 || sort_every_ > 0) return;
  sort_every_ = atom->sortfreq;
  atom->sortfreq = 0;
}

void FixSetupMemory::allow_sorting() {
  if (sort_every_ > 0) atom->sortfreq = sort_every_;
  sort_every_ = 0;
}

FixSetupMemory::Box FixSetupMemory::box_now() const {
  Box box;
  std::copy(domain->boxlo, domain->boxlo + 3, box.low);
  std::copy(domain->boxhi, domain->boxhi + 3, box.high);
  const double tilts[3] = {domain->yz, domain->xz, domain->xy};
  for (int k = 0; k < 3; k++) box.tilts[k] = domain->triclinic ? tilts[k] : 0.0;
  std::copy(domain->h_rate, domain->h_rate + 6, box.rates);
  std::copy(domain->h_ratelo, domain->h_ratelo + 3, box.low_rates);
  return box;
}

/** Of the host's numbers those that tell where ghosts are and how they move. */
void FixSetupMemory::set_box(const Box &box) {
  std::copy(box.low, box.low + 3, domain->boxlo);
  std::copy(box.high, box.high + 3, domain->boxhi);
  if (domain->triclinic) {
    domain->yz = box.tilts[0];
    domain->xz = box.tilts[1];
    domain->xy = box.tilts[2];
  }
  std::copy(box.rates, box.rates + 6, domain->h_rate);
  std::copy(box.low_rates, box.low_rates + 3, domain->h_ratelo);
  domain->set_global_box();
}

/** A grain was wrapped since its last evaluation: place and velocity that it would have had there. */
void FixSetupMemory::carry_across(int i, tagint image_before) {
  int n[3];
  grainscope::edges_crossed(image_before, atom->image[i], n);
  const Box &box = shared_.evaluated;
  double *place = of(i) + half_x, *v = of(i) + half_v, edges[3];
  for (int k = 0; k < 3; k++) edges[k] = box.high[k] - box.low[k];
  place[0] -= n[0] * edges[0] + n[1] * box.tilts[2] + n[2] * box.tilts[1];
  place[1] -= n[1] * edges[1] + n[2] * box.tilts[0];
  place[2] -= n[2] * edges[2];
  if (!domain->deform_vremap || !(atom->mask[i] & domain->deform_groupbit)) return;
  v[0] -= n[0] * box.rates[0] + n[1] * box.rates[5] + n[2] * box.rates[4];
  v[1] -= n[1] * box.rates[1] + n[2] * box.rates[3];
  v[2] -= n[2] * box.rates[2];
}

/** Whether grain i is as it was at the end of the last run, but for wrapping. */
bool FixSetupMemory::same(int i) const {
  const double *mine = of(i);
  if (mine[known] != 1.0 || mine[state_hash] != grainscope::state_hash(atom, i)) return false;
  const tagint before = as_image(mine[image]);
  if (before == atom->image[i] && mine[velocity_hash] != grainscope::velocity_hash(atom, i)) return false;
  int n[3];
  grainscope::edges_crossed(before, atom->image[i], n);
  const double shift[3] = {n[0] * domain->xprd + n[1] * domain->xy + n[2] * domain->xz, n[1] * domain->yprd + n[2] * domain->yz, n[2] * domain->zprd};
  for (int k = 0; k < 3; k++)
    if (!(std::fabs(atom->x[i][k] - mine[x + k] + shift[k]) <= same_place * domain->prd[k])) return false;
  return true;
}

/** Old forces do not hold when a fix that adds to them comes or goes. In any order: that of a deck after read_restart may be another. */
double FixSetupMemory::movers_now() const {
  double sum = 0.0;
  for (int k = 0; k < modify->nfix; k++) {
    const Fix *fix = modify->fix[k];
    if (!(modify->fmask[k] & FixConst::POST_FORCE) && !fix->time_integrate) continue;
    sum += grainscope::text_hash(std::string(fix->id) + ' ' + fix->style) % 1000003 + fix->groupbit;
  }
  return sum;
}

/** Whether images are where they were. A face that is not periodic pushes no grain, wherever it is: one that follows the
 *  grains is set again when the run begins. */
bool FixSetupMemory::same_box() const {
  const Box box = box_now(), &then = shared_.ended;
  const int periodic[3] = {domain->xperiodic, domain->yperiodic, domain->zperiodic};
  for (int k = 0; k < 3; k++)
    if (periodic[k] && (box.low[k] != then.low[k] || box.high[k] != then.high[k])) return false;
  return std::equal(box.tilts, box.tilts + 3, then.tilts);
}

/** Collective. */
bool FixSetupMemory::unchanged() const {
  int changed = shared_.grains != static_cast<double>(atom->natoms) || shared_.dt != update->dt ||
      shared_.movers != movers_now() || !same_box();
  for (int i = 0; i < atom->nlocal && !changed; i++) changed = !same(i);
  const bool nothing = shared_.grains < 0.0;
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, world);
  if (changed && !nothing && comm->me == 0)
    for (FILE *out : {screen, logfile})
      if (out)
        fprintf(out, "pair_style gran/insitu: grains, box, time step or fixes were changed since the last run: "
                "forces are recomputed with the velocities of whole steps, within the friction limit\n");
  return !changed;
}

void FixSetupMemory::swap_evaluation() {
  const Box now = box_now();
  set_box(shared_.evaluated);
  shared_.evaluated = now;
  for (int i = 0; i < atom->nlocal; i++) {
    std::swap_ranges(atom->x[i], atom->x[i] + 3, of(i) + half_x);
    std::swap_ranges(atom->v[i], atom->v[i] + 3, of(i) + half_v);
    std::swap_ranges(atom->omega[i], atom->omega[i] + 3, of(i) + half_omega);
  }
  comm->forward_comm();
}

void FixSetupMemory::setup_pre_force(int) {
  allow_sorting();
  again_ = unchanged();
  if (again_) {
    atom->nextsort = update->ntimestep + static_cast<bigint>(shared_.to_sort);
    for (int i = 0; i < atom->nlocal; i++) {
      const tagint before = as_image(of(i)[image]);
      if (before == atom->image[i]) std::copy(of(i) + x, of(i) + x + 3, atom->x[i]);  // looking whether to wrap cost a few bits
      else carry_across(i, before);
    }
    next_reneighbor = update->ntimestep + 1;
    return;
  }
  pre_force(0);
}

void FixSetupMemory::setup(int) {
  if (!again_) return;
  again_ = false;
  for (int i = 0; i < atom->nlocal; i++) {
    std::copy(of(i) + f, of(i) + f + 3, atom->f[i]);
    std::copy(of(i) + torque, of(i) + torque + 3, atom->torque[i]);
  }
}

void FixSetupMemory::pre_force(int) {
  running_ = update->setupflag == 0;
  shared_.evaluated = box_now();
  for (int i = 0; i < atom->nlocal; i++) {
    std::copy(atom->x[i], atom->x[i] + 3, of(i) + half_x);
    std::copy(atom->v[i], atom->v[i] + 3, of(i) + half_v);
    std::copy(atom->omega[i], atom->omega[i] + 3, of(i) + half_omega);
  }
}

/** Everything but what must be taken at the time of the evaluation. */
void FixSetupMemory::take_rest() {
  shared_.grains = atom->natoms;
  shared_.dt = update->dt;
  shared_.to_sort = atom->nextsort - update->ntimestep;
  shared_.movers = movers_now();
  shared_.ended = box_now();
  for (int i = 0; i < atom->nlocal; i++) {
    double *mine = of(i);
    mine[known] = 1.0;
    std::copy(atom->f[i], atom->f[i] + 3, mine + f);
    std::copy(atom->torque[i], atom->torque[i] + 3, mine + torque);
    std::copy(atom->x[i], atom->x[i] + 3, mine + x);
    mine[image] = 0.0;
    std::memcpy(&mine[image], &atom->image[i], sizeof atom->image[i]);
    mine[velocity_hash] = grainscope::velocity_hash(atom, i);
    mine[state_hash] = grainscope::state_hash(atom, i);
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
    if (atom->image[i] == images[i]) std::copy(&places[3 * i], &places[3 * i] + 3, atom->x[i]);
    else carry_across(i, images[i]);
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
  const double *numbers = grainscope::restart_numbers(atom, i, nth, width);
  if (!numbers)
    error->one(FLERR, "pair_style gran/insitu: the restart file holds another kind of memory of the set-up: say "
                      "'setup host'");
  std::copy(numbers, numbers + width, of(i));
}

/** Comes before the grains are written. */
void FixSetupMemory::write_restart(FILE *file) {
  if (running_) {
    if (atom->nlocal) wrap_now();
    take_rest();
    next_reneighbor = update->ntimestep + 1;  // the run that begins from the file has new lists then, too
  }
  if (comm->me != 0) return;
  const int size = sizeof shared_;
  fwrite(&size, sizeof size, 1, file);
  fwrite(&shared_, 1, size, file);
}

void FixSetupMemory::restart(char *buffer) { memcpy(&shared_, buffer, sizeof shared_); }
