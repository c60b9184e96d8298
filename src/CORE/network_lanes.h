// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_NETWORK_LANES_H
#define GRAINSCOPE_NETWORK_LANES_H

#include "contact_lanes.h"
#include "pressure_control.h"

namespace grainscope {

/** The sums of a NetworkResponse, lane by lane. */
class NetworkLanes {
 public:
  void reset() { *this = NetworkLanes(); }
  void add(const ContactLanes &contacts, const NetworkResponse::Pairs &pairs);
  /** What was added, in one. */
  NetworkResponse sum() const;

 private:
  std::array<Lanes, 6> pressure_{};
  std::array<Lanes, 21> stiffness_{}, damping_{};
};

}

#endif
