// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRIVATE_MEMBER_H
#define GRAINSCOPE_PRIVATE_MEMBER_H

// clang-format off
/** GRAINSCOPE_PRIVATE_MEMBER(RegSphere, double, radius) makes a function radius_of(RegSphere *) that gives the private
 *  member `radius` of a class of LIGGGHTS that has no accessor for it. The names in an explicit instantiation may
 *  be private (ISO C++17, [temp.spec]/6). In an unnamed namespace of one source file. */
#define GRAINSCOPE_PRIVATE_MEMBER(Class, Type, member)                                                 \
  struct Class##_##member {                                                                            \
    using Pointer = Type LAMMPS_NS::Class::*;                                                          \
    friend Pointer pointer_to(Class##_##member);                                                       \
  };                                                                                                   \
  template <Class##_##member::Pointer pointer>                                                         \
  struct Class##_##member##_exposed {                                                                  \
    friend Class##_##member::Pointer pointer_to(Class##_##member) { return pointer; }                  \
  };                                                                                                   \
  template struct Class##_##member##_exposed<&LAMMPS_NS::Class::member>;                               \
  auto &member##_of(LAMMPS_NS::Class *object) { return object->*pointer_to(Class##_##member()); }
// clang-format on

#endif
