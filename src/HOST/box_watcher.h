// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_BOX_WATCHER_H
#define GRAINSCOPE_BOX_WATCHER_H

namespace grainscope {

/** A compute that follows grains in the moving box and must know when `change_box` changes the box between runs: this
 *  is neither a motion of the grains nor a flow. Both members are called on all ranks; between the calls grains may
 *  change ranks. */
class BoxWatcher {
 public:
  virtual ~BoxWatcher() = default;
  virtual void before_change_box() = 0;
  virtual void after_change_box() = 0;
};

}

#endif
