// SPDX-License-Identifier: GPL-2.0-or-later
#include "solid.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace grainscope {

using Eigen::Vector3d;

namespace {

using Part = std::pair<double, double>;

const Part nothing(1.0, 0.0);
const double rounding = 1e-12;  // of lengths that are compared

Part both(const Part &a, const Part &b) { return {std::max(a.first, b.first), std::min(a.second, b.second)}; }

double length(const Part &part) { return std::max(part.second - part.first, 0.0); }

/** Where a + b t <= 0, or < 0. */
Part below(double a, double b, bool strictly) {
  if (b == 0.0) return (strictly ? a < 0.0 : a <= 0.0) ? Part(0.0, 1.0) : nothing;
  return b > 0.0 ? Part(0.0, -a / b) : Part(-a / b, 1.0);
}

/** Where c + 2 b t + a t^2 <= 0 within `range`, of which it is one part. */
Part below_parabola(double a, double b, double c, const Part &range) {
  const double square = b * b - a * c;
  if (square <= 0.0) return a > 0.0 || (a == 0.0 && c > 0.0) ? nothing : range;
  const double root = b > 0.0 ? -(b + std::sqrt(square)) : -b + std::sqrt(square);
  double first = root / a, second = c / root;
  if (a == 0.0) return both(range, b > 0.0 ? Part(0.0, second) : Part(second, 1.0));
  if (first > second) std::swap(first, second);
  if (a > 0.0) return both(range, {first, second});
  const Part before = both(range, {0.0, first}), after = both(range, {second, 1.0});
  return length(before) > length(after) ? before : after;
}

LineParts outside_of(const LineParts &parts) {
  LineParts gaps;
  double from = 0.0;
  for (const Part &one : parts) {
    if (one.first > from) gaps.push_back({from, one.first});
    from = one.second;
  }
  if (from < 1.0) gaps.push_back({from, 1.0});
  return gaps;
}

LineParts common_parts(const LineParts &a, const LineParts &b) {
  LineParts all;
  for (const Part &one : a)
    for (const Part &other : b) {
      const Part shared = both(one, other);
      if (shared.first < shared.second) all.push_back(shared);
    }
  return all;
}

}

double length_of(const LineParts &parts, double low, double high) {
  double sum = 0.0;
  for (const Part &one : parts) sum += length(both(one, {low, high}));
  return sum;
}

Solid Solid::flat(std::vector<HalfSpace> sides) {
  Solid made;
  made.sides_ = std::move(sides);
  return made;
}

Solid Solid::ball(const Vector3d &centre, double radius) {
  Solid made;
  made.kind_ = Kind::ball;
  made.origin_ = centre;
  made.radius_lo_ = made.radius_hi_ = radius;
  return made;
}

Solid Solid::round(const Vector3d &origin, const Vector3d &axis, double lo, double hi, double radius_lo,
                   double radius_hi) {
  Solid made = ball(origin, radius_lo);
  made.kind_ = Kind::round;
  made.axis_ = axis;
  made.lo_ = lo;
  made.hi_ = hi;
  made.radius_hi_ = radius_hi;
  return made;
}

Solid Solid::common(std::vector<Solid> members) {
  Solid made;
  made.kind_ = Kind::common;
  made.members_ = std::move(members);
  return made;
}

Solid Solid::united(std::vector<Solid> members) {
  Solid made = common(std::move(members));
  made.kind_ = Kind::united;
  return made;
}

Solid Solid::complement() const {
  Solid other = *this;
  other.outside_ = !outside_;
  return other;
}

Solid Solid::moved(const Eigen::Matrix3d &turn, const Vector3d &shift) const {
  Solid other = *this;
  for (HalfSpace &side : other.sides_) {
    side.normal = turn * side.normal;
    side.distance += side.normal.dot(shift);
  }
  other.origin_ = turn * origin_ + shift;
  other.axis_ = turn * axis_;
  for (Solid &member : other.members_) member = member.moved(turn, shift);
  return other;
}

double Solid::radius_at(double distance) const {
  if (radius_lo_ == radius_hi_) return radius_lo_;
  return radius_lo_ + (distance - lo_) * (radius_hi_ - radius_lo_) / (hi_ - lo_);
}

/** Of a convex body, as if it had no outside. */
Part Solid::convex_part(const Vector3d &from, const Vector3d &to) const {
  const Vector3d along = to - from, start = from - origin_;
  Part part(0.0, 1.0);
  for (const HalfSpace &side : sides_) part = both(part, below(side.height(from), side.normal.dot(along), side.open));
  if (kind_ == Kind::flat || length(part) == 0.0) return part;
  if (kind_ == Kind::ball)
    return below_parabola(along.squaredNorm(), start.dot(along), start.squaredNorm() - radius_lo_ * radius_lo_, part);
  const double height = axis_.dot(start), climb = axis_.dot(along);
  part = both(part, both(below(lo_ - height, -climb, false), below(height - hi_, climb, true)));
  if (length(part) == 0.0) return nothing;
  const Vector3d across = along - climb * axis_, off = start - height * axis_;
  const double radius = radius_at(height), widening = radius_at(height + climb) - radius;
  return below_parabola(across.squaredNorm() - widening * widening, off.dot(across) - radius * widening,
                        off.squaredNorm() - radius * radius, part);
}

LineParts Solid::parts(const Vector3d &from, const Vector3d &to) const {
  LineParts inside;
  if (kind_ == Kind::common) {
    inside = {{0.0, 1.0}};
    for (const Solid &member : members_) inside = common_parts(inside, member.parts(from, to));
  } else if (kind_ == Kind::united) {
    LineParts free = {{0.0, 1.0}};  // of all members
    for (const Solid &member : members_) free = common_parts(free, outside_of(member.parts(from, to)));
    inside = outside_of(free);
  } else {
    const Part part = convex_part(from, to);
    if (part.first < part.second) inside = {part};
  }
  return outside_ ? outside_of(inside) : inside;
}

/** A ball or round body between half spaces that contain it or, of a round body, cut it across its axis. */
bool Solid::volume_between(const std::vector<HalfSpace> &sides, double &volume, std::string &why) const {
  double lo = kind_ == Kind::ball ? 0.0 : lo_, hi = kind_ == Kind::ball ? 0.0 : hi_;
  std::vector<HalfSpace> others;
  for (const HalfSpace &side : sides) {
    const double along = side.normal.dot(axis_), height = -side.height(origin_);
    if (kind_ == Kind::ball || std::fabs(along) < 1.0 - rounding) others.push_back(side);
    else if (along > 0.0) hi = std::min(hi, height);
    else lo = std::max(lo, -height);
  }
  if (kind_ == Kind::round && lo >= hi) {
    volume = 0.0;
    return true;
  }
  for (const HalfSpace &side : others)
    for (double end : {lo, hi}) {
      const double across =
          kind_ == Kind::ball ? 1.0 : std::sqrt(std::max(0.0, 1.0 - std::pow(side.normal.dot(axis_), 2)));
      const double radius = kind_ == Kind::ball ? radius_lo_ : radius_at(end);
      if (side.height(origin_ + end * axis_) + radius * across > rounding * (radius + std::fabs(side.distance))) {
        why = kind_ == Kind::ball ? "a face cuts the sphere" : "a face cuts the cylinder or cone beside its axis";
        return false;
      }
    }
  const double a = radius_at(lo), b = radius_at(hi);
  volume = kind_ == Kind::ball ? 4.0 / 3.0 * M_PI * std::pow(radius_lo_, 3)
                               : M_PI * (hi - lo) * (a * a + a * b + b * b) / 3.0;
  return true;
}

bool Solid::volume_of_common(const Polyhedron &box, double &volume, std::string &why) const {
  const Solid *curved = nullptr;
  std::vector<HalfSpace> sides;
  std::vector<const Solid *> open = {this};
  while (!open.empty()) {
    const Solid &one = *open.back();
    open.pop_back();
    if (one.kind_ == Kind::common && !one.outside_) {
      for (const Solid &member : one.members_) open.push_back(&member);
    } else if (one.kind_ == Kind::flat && !one.outside_) {
      sides.insert(sides.end(), one.sides_.begin(), one.sides_.end());
    } else if (one.kind_ == Kind::flat && one.sides_.size() == 1) {
      sides.push_back({-one.sides_[0].normal, -one.sides_[0].distance});
    } else if ((one.kind_ == Kind::ball || one.kind_ == Kind::round) && !one.outside_ && !curved) {
      curved = &one;
    } else {
      why = one.kind_ == Kind::united ? "it is a union"
                                      : "it is an intersection with an outside or with two round regions";
      return false;
    }
  }
  if (curved) {
    sides.insert(sides.end(), box.sides().begin(), box.sides().end());
    return curved->volume_between(sides, volume, why);
  }
  Polyhedron left = box;
  for (const HalfSpace &side : sides) left.cut(side);
  volume = left.volume();
  return true;
}

bool Solid::volume_within(const Polyhedron &box, double &volume, std::string &why) const {
  Solid inner = *this;
  inner.outside_ = false;
  if (!inner.volume_of_common(box, volume, why)) return false;
  if (outside_) volume = box.volume() - volume;
  return true;
}

bool Solid::section(double height, Solid &cut, std::string &why) const {
  cut = *this;
  if (kind_ == Kind::common || kind_ == Kind::united) {
    for (Solid &member : cut.members_)
      if (!Solid(member).section(height, member, why)) return false;
    return true;
  }
  const Vector3d up = Vector3d::UnitZ();
  const bool upright = std::fabs(axis_.dot(up)) > 1.0 - rounding;
  const bool nowhere = kind_ == Kind::ball && std::fabs(height - origin_[2]) > radius_lo_;
  if (kind_ == Kind::round && !upright) {
    why = "in two dimensions a cylinder or cone must have its axis along z";
    return false;
  }
  if (kind_ == Kind::ball || kind_ == Kind::round) {
    const double s = (height - origin_[2]) * (axis_[2] > 0.0 ? 1.0 : -1.0);
    const double radius =
        kind_ == Kind::ball ? std::sqrt(std::max(0.0, radius_lo_ * radius_lo_ - s * s)) : radius_at(s);
    const bool hit = kind_ == Kind::ball ? !nowhere : s >= lo_ && s <= hi_;
    cut = round({origin_[0], origin_[1], 0.0}, up, -1e20, 1e20, hit ? radius : 0.0, hit ? radius : 0.0);
    cut.outside_ = outside_;
    return true;
  }
  cut.sides_.clear();
  for (const HalfSpace &side : sides_) {
    const Vector3d flat(side.normal[0], side.normal[1], 0.0);
    const double size = flat.norm(), distance = side.distance - side.normal[2] * height;
    if (size > rounding) cut.sides_.push_back({flat / size, distance / size, side.open});
    else if (distance < 0.0) cut.sides_.push_back({Vector3d::UnitX(), -1e20});  // nothing is left
  }
  return true;
}

}
