// SPDX-License-Identifier: GPL-2.0-or-later
#ifdef FIX_CLASS

FixStyle(wall/gran,FixWallGranInsitu)

#else

#ifndef LMP_FIX_WALL_GRAN_INSITU_H
#define LMP_FIX_WALL_GRAN_INSITU_H

#include "fix_wall_gran.h"
#include "wall_contacts_owner.h"
#include <memory>
#include <string>
#include <vector>

namespace grainscope {
struct ContactLaw;

/** One wall: a primitive fix wall/gran, or one mesh of a fix wall/gran for meshes. */
struct Wall {
  std::string name;  // ID of the fix wall/gran, or of the mesh
  LAMMPS_NS::FixWallGran *fix;
  LAMMPS_NS::FixMeshSurface *mesh;      // null for a primitive wall
  const ContactLaw *law;                // of the run that was set up last; null without pair_style gran/insitu
  std::vector<std::string> primitive;   // of a primitive wall, as in the command: zplane 0.0
  LAMMPS_NS::FixPropertyAtom *history;  // of a primitive wall's contacts, if it has one
};

/** All walls, in the order of their fixes: PartnerWall::wall counts them so. */
std::vector<Wall> walls_of(LAMMPS_NS::LAMMPS *lmp);

}

namespace LAMMPS_NS {

/** The fix wall/gran of LIGGGHTS, with every contact offered to the computes and fixes that see the contacts of
 *  pair_style gran/insitu. Same arguments, same trajectory to the last bit, with any pair style; see
 *  doc/fix_wall_gran.md. */
class FixWallGranInsitu : public FixWallGran, public grainscope::WallContactsOwner {
 public:
  FixWallGranInsitu(class LAMMPS *lmp, int narg, char **arg);
  ~FixWallGranInsitu() override;
  void post_create_pre_restart() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  void post_run() override;
  void write_restart(FILE *file) override;
  void restart(char *buffer) override;
  int add_history_value(std::string name, std::string newtonflag) override;

  grainscope::WallContacts &wall_contacts() override;
  /** Adds its walls, in order. */
  void add_to(std::vector<grainscope::Wall> &walls);

 private:
  struct Impl;
  struct Words;
  std::unique_ptr<Impl> impl_;

  FixWallGranInsitu(class LAMMPS *lmp, Words words);
  void synchronize();
  std::string who() const;
  std::string column_names();
  grainscope::ContactLaw law_of_models();

  std::vector<TriMesh *> meshes();
  bool keeps_velocities();
  void require_across_plane();
};

}

#endif
#endif
