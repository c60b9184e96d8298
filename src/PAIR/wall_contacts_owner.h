// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_WALL_CONTACTS_OWNER_H
#define GRAINSCOPE_WALL_CONTACTS_OWNER_H

namespace grainscope {

struct WallContacts;

/** A fix wall/gran whose contacts are to be seen. */
class WallContactsOwner {
 public:
  virtual ~WallContactsOwner() = default;
  virtual WallContacts &wall_contacts() = 0;
};

}

#endif
