// SPDX-License-Identifier: GPL-2.0-or-later
#include "change_box_watched.h"
#include "box_watcher.h"
#include "change_box.h"
#include "compute.h"
#include "domain.h"
#include "modify.h"
#include <vector>

using namespace LAMMPS_NS;

void ChangeBoxWatched::command(int narg, char **arg) {
  std::vector<grainscope::BoxWatcher *> watchers;
  if (domain->box_exist)
    for (int k = 0; k < modify->ncompute; k++)
      if (auto *one = dynamic_cast<grainscope::BoxWatcher *>(modify->compute[k])) watchers.push_back(one);
  for (grainscope::BoxWatcher *one : watchers) one->before_change_box();
  ChangeBox(lmp).command(narg, arg);
  for (grainscope::BoxWatcher *one : watchers) one->after_change_box();
}
