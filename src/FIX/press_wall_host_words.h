// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_PRESS_WALL_HOST_WORDS_H
#define GRAINSCOPE_PRESS_WALL_HOST_WORDS_H

#include <string>
#include <vector>

namespace grainscope {

/** The command that the host's fix move/mesh is given: a motion at rest. */
class PressWallHostWords {
 public:
  PressWallHostWords(char **arg, const std::string &mesh)
      : words_{arg[0], arg[1], "move/mesh", "mesh", mesh, "linear", "0", "0", "0"} {
    for (std::string &word : words_) pointers_.push_back(&word[0]);
  }
  PressWallHostWords(const PressWallHostWords &) = delete;
  int size() const { return static_cast<int>(pointers_.size()); }
  char **words() { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char *> pointers_;  // into words_
};

}

#endif
