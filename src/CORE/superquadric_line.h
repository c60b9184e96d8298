// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef GRAINSCOPE_SUPERQUADRIC_LINE_H
#define GRAINSCOPE_SUPERQUADRIC_LINE_H

#include <string>
#include <vector>

namespace grainscope {

/** Lines of a data file of superquadrics, in the sections Atoms and Velocities; see doc/data_files.md.
 *  Atoms: id type density shapex shapey shapez blockiness1 blockiness2 x y z [quatw quatx quaty quatz] [ix iy iz]
 *  Velocities: id vx vy vz omegax omegay omegaz */
namespace superquadric_line {

constexpr int bare = 11, quaternion = 4, images = 3, velocity = 7;

/** The words of a line: up to its end, or a '#'. */
std::vector<std::string> words_of(const char *line);

/** Columns without image flags of a line of so many words; 0 for a wrong number. */
int columns_without_images(int words);

/** What is wrong with a line of the section Atoms, or nothing. Image flags: from -images_limit to images_limit - 1. */
std::string problem_of_grain(const std::vector<std::string> &words, int types, int images_limit);

/** What is wrong with a line of the section Velocities, or nothing. */
std::string problem_of_velocity(const std::vector<std::string> &words);

/** The quaternion of length 1, to the last bit as it was if it has this length but for rounding. */
void normalise(double *quaternion);

/** The shortest of 15, 16 and 17 digits that reads back as the same double. */
std::string text_of(double value);

}
}

#endif
