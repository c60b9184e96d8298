// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_IDS_H
#define GRAINSCOPE_CONTACT_IDS_H

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** Whether grains have the IDs under which LIGGGHTS stored the springs of their contacts. `delete_atoms` renumbers
 *  grains unless it has `compress no`, and the springs then belong to other grains. Detected by pairs of which one
 *  grain knows the contact and the other does not. Call it after grains were deleted, before the next run: later the
 *  stored IDs may be out of date. Collective. */
bool contacts_know_their_grains(LAMMPS_NS::LAMMPS *lmp);

}

#endif
