// SPDX-License-Identifier: GPL-2.0-or-later
#include "atom_vec_superquadric_files.h"
#include "superquadric_line.h"
#include "atom.h"
#include "error.h"
#include "math_extra_liggghts_nonspherical.h"
#include "math_extra_liggghts_superquadric.h"
#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;
namespace line = grainscope::superquadric_line;

namespace {

constexpr int columns_with_quaternion = line::bare + line::quaternion;

/** Calls `use` with the words of each of `n` lines. */
template <class Use>
void for_each_line(int n, const char *lines, Use use) {
  for (int k = 0; k < n; k++) {
    use(line::words_of(lines));
    const char *end = strchr(lines, '\n');
    if (!end) return;
    lines = end + 1;
  }
}

std::string id_of(const std::vector<std::string> &words) { return words.empty() ? "(an empty line)" : words[0]; }

bool alike(double a, double b, double tolerance = 1e-12) { return std::fabs(a - b) <= tolerance * std::fabs(b); }

/** LIGGGHTS makes bounding spheres 1e-4 wider, except those of grains that were never given a shape. */
constexpr double margin = 2e-4;

}

AtomVecSuperquadricFiles::AtomVecSuperquadricFiles(LAMMPS *lmp)
    : AtomVecSuperquadric(lmp), columns_(columns_with_quaternion) {
  size_data_atom = columns_with_quaternion;
}

void AtomVecSuperquadricFiles::refuse(const char *section, const std::string &id, const std::string &problem) {
  const std::string where = "read_data: " + std::string(section) + " of atom_style superquadric, grain " + id;
  error->all(FLERR, (where + ": " + problem).c_str());
}

int AtomVecSuperquadricFiles::columns_of_atoms(int n, char *lines) {
  std::size_t first = 0;
  for_each_line(n, lines, [&](const std::vector<std::string> &words) {
    std::string problem = line::problem_of_grain(words, atom->ntypes, IMGMAX);
    if (!first) first = words.size();
    if (problem.empty() && words.size() != first)
      problem = "all lines must have the same number of columns, got " + std::to_string(words.size()) + " after " +
                std::to_string(first);
    if (!problem.empty()) refuse("Atoms", id_of(words), problem);
  });
  columns_ = line::columns_without_images(first);
  return columns_;
}

void AtomVecSuperquadricFiles::check_velocities(int n, char *lines) {
  for_each_line(n, lines, [&](const std::vector<std::string> &words) {
    const std::string problem = line::problem_of_velocity(words);
    if (!problem.empty()) refuse("Velocities", id_of(words), problem);
  });
}

/** Mass, moments, volume, area and bounding sphere follow from shape and density as the command `set` has them. */
void AtomVecSuperquadricFiles::data_atom(double *x, tagint image, char **values) {
  AtomVecSuperquadric::data_atom(x, image, values);
  if (columns_ != columns_with_quaternion) return;
  double *quaternion = atom->quaternion[atom->nlocal - 1];
  for (int k = 0; k < line::quaternion; k++) quaternion[k] = atof(values[line::bare + k]);
  line::normalise(quaternion);
}

/** Integrators continue from the angular momentum. */
void AtomVecSuperquadricFiles::data_vel(int i, char **values) {
  using MathExtraLiggghtsNonspherical::omega_to_angmom;
  AtomVecSuperquadric::data_vel(i, values);
  omega_to_angmom(atom->quaternion[i], atom->omega[i], atom->inertia[i], atom->angmom[i]);
}

/** A file holds no mass and no moments. Collective: every rank names the same grain. */
void AtomVecSuperquadricFiles::require_grains_of_shape_and_density() {
  using namespace MathExtraLiggghtsNonspherical;
  int first = INT_MAX;
  for (int i = 0; i < atom->nlocal; i++) {
    double radius, volume, inertia[3];
    double *shape = atom->shape[i], *blockiness = atom->blockiness[i];
    bounding_sphere_radius_superquadric(shape, blockiness, &radius);
    volume_superquadric(shape, blockiness, &volume);
    inertia_superquadric(shape, blockiness, atom->density[i], inertia);
    bool kept = alike(atom->radius[i], radius, margin) && alike(atom->volume[i], volume);
    kept = kept && alike(atom->rmass[i], volume * atom->density[i]);
    for (int k = 0; k < 3; k++) kept = kept && alike(atom->inertia[i][k], inertia[k]);
    if (!kept) first = std::min(first, atom->tag[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world);
  if (first == INT_MAX) return;
  const std::string grain = std::to_string(first);
  const std::string problem = "write_data: the radius, volume, mass or moments of inertia of grain " + grain +
                              " are not those of its shape and density, and a data file of superquadrics cannot hold "
                              "others: set its shape and density, or use write_restart";
  error->all(FLERR, problem.c_str());
}

void AtomVecSuperquadricFiles::pack_data(double **buf, int tag_offset) {
  require_grains_of_shape_and_density();
  for (int i = 0; i < atom->nlocal; i++) {
    double *to = buf[i];
    *to++ = ubuf(atom->tag[i] + tag_offset).d;
    *to++ = ubuf(atom->type[i]).d;
    *to++ = atom->density[i];
    to = std::copy(atom->shape[i], atom->shape[i] + 3, to);
    to = std::copy(atom->blockiness[i], atom->blockiness[i] + 2, to);
    to = std::copy(atom->x[i], atom->x[i] + 3, to);
    to = std::copy(atom->quaternion[i], atom->quaternion[i] + 4, to);
    const tagint image = atom->image[i];
    *to++ = ubuf(static_cast<int64_t>((image & IMGMASK) - IMGMAX)).d;
    *to++ = ubuf(static_cast<int64_t>((image >> IMGBITS & IMGMASK) - IMGMAX)).d;
    *to++ = ubuf(static_cast<int64_t>((image >> IMG2BITS) - IMGMAX)).d;
  }
}

/** An angular velocity that does not match the angular momentum would not be the one that a run continues with. */
void AtomVecSuperquadricFiles::pack_vel(double **buf, int tag_offset) {
  AtomVecSuperquadric::pack_vel(buf, tag_offset);
  for (int i = 0; i < atom->nlocal; i++) {
    double omega[3], off = 0.0, scale = 0.0;
    MathExtraLiggghtsNonspherical::angmom_to_omega(atom->quaternion[i], atom->angmom[i], atom->inertia[i], omega);
    for (int k = 0; k < 3; k++) {
      off = std::max(off, std::fabs(omega[k] - buf[i][4 + k]));
      scale = std::max(scale, std::fabs(omega[k]));
    }
    if (off > 1e-9 * scale) std::copy(omega, omega + 3, buf[i] + 4);
  }
}

void AtomVecSuperquadricFiles::write_data(FILE *file, int n, double **buf) {
  for (int i = 0; i < n; i++) {
    std::string text = std::to_string(ubuf(buf[i][0]).i) + " " + std::to_string(ubuf(buf[i][1]).i);
    for (int k = 2; k < columns_with_quaternion; k++) text += " " + line::text_of(buf[i][k]);
    for (int k = 0; k < line::images; k++) text += " " + std::to_string(ubuf(buf[i][columns_with_quaternion + k]).i);
    fprintf(file, "%s\n", text.c_str());
  }
}
