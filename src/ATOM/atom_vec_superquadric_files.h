// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef ATOM_CLASS

// clang-format off
AtomStyle(superquadric,AtomVecSuperquadricFiles)

AtomStyle(granular_superquadric,AtomVecSuperquadricFiles)
// clang-format on

#else

#ifndef LMP_ATOM_VEC_SUPERQUADRIC_FILES_H
#define LMP_ATOM_VEC_SUPERQUADRIC_FILES_H

#include "atom_vec_superquadric.h"
#include <string>

namespace LAMMPS_NS {

/** The atom style superquadric of LIGGGHTS, with data files that hold all of a grain: shape, orientation, images, spin.
 *  Mended lines of Atom and AtomVec call two of its members.
 *  See doc/data_files.md. */
class AtomVecSuperquadricFiles : public AtomVecSuperquadric {
 public:
  explicit AtomVecSuperquadricFiles(class LAMMPS *lmp);

  /** Reads `n` lines of the section Atoms; returns the number of columns without image flags. Collective. */
  int columns_of_atoms(int n, char *lines) override;
  /** Checks `n` lines of the section Velocities. Collective. */
  void check_velocities(int n, char *lines) override;

  void data_atom(double *x, tagint image, char **values) override;
  void data_vel(int i, char **values) override;
  void pack_data(double **buf) override { pack_data(buf, 0); }
  void pack_data(double **buf, int tag_offset) override;
  void write_data(FILE *file, int n, double **buf) override;
  void pack_vel(double **buf) override { pack_vel(buf, 0); }
  void pack_vel(double **buf, int tag_offset) override;

 private:
  int columns_;  // of the lines that data_atom is given

  void refuse(const char *section, const std::string &id, const std::string &problem);
  void require_grains_of_shape_and_density();
};

}

#endif
#endif
