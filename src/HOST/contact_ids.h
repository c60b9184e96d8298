// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_CONTACT_IDS_H
#define GRAINSCOPE_CONTACT_IDS_H

namespace LAMMPS_NS {
class LAMMPS;
}

namespace grainscope {

/** Whether grains bear the IDs that the host noted their contacts' springs under. `delete_atoms` renumbers the rest
 *  unless it has `compress no`, and the springs go to whom the old IDs now name. Detected by grains of which one knows
 *  the contact and the other does not. After grains were deleted, before the next run: later what the host noted may be
 *  old. Collective. */
bool contacts_know_their_grains(LAMMPS_NS::LAMMPS *lmp);

}

#endif
