// SPDX-License-Identifier: GPL-2.0-or-later
#include "restart_seal.h"
#include <boost/crc.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <unistd.h>
#include <vector>

namespace grainscope { namespace restart_seal {

namespace {

const char mark[16] = {'\n', 'g', 'r', 'a', 'i', 'n', 's', 'c', 'o', 'p', 'e', ' ', 's', 'e', 'a', 'l'};

struct Seal {
  char mark[16];
  std::uint64_t length;    // of what stands before the seal
  std::uint32_t checksum;  // of the same
  std::uint32_t format;
};

struct Close {
  void operator()(std::FILE *file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

const std::size_t piece = std::size_t(1) << 20;
const std::uint64_t least_per_grain = 12 * sizeof(double);  // of every atom style that grains can have

/** Hands all bytes of the file, up to `length`, to `take`, a piece at a time; false when there are fewer. */
template <class Take>
bool read_bytes(std::FILE *file, std::uint64_t length, Take take) {
  std::vector<char> bytes(piece);
  while (length > 0) {
    const std::size_t wanted = std::min<std::uint64_t>(length, piece);
    if (std::fread(bytes.data(), 1, wanted, file) != wanted) return false;
    take(bytes.data(), wanted);
    length -= wanted;
  }
  return true;
}

std::uint64_t length_of(std::FILE *file) {
  std::fseek(file, 0, SEEK_END);
  const long length = std::ftell(file);
  std::rewind(file);
  return length > 0 ? length : 0;
}

/** The host's header: a number that says what follows, and the value. It begins with version, three sizes of integers,
 *  units and step. */
class Header {
 public:
  explicit Header(std::FILE *file) : file_(file) {}

  std::int64_t step = -1, grains = 0;

  bool read() {
    std::string version, units, style;
    if (!text(0, version) || version.find("LIGGGHTS") == std::string::npos) return false;
    for (int size = 1; size <= 3; size++) {
      std::int32_t bytes;
      if (!flag(size) || !value(bytes) || (bytes != 4 && bytes != 8)) return false;
    }
    if (!text(4, units) || !flag(5) || !value(step) || step < 0) return false;
    for (int number = 6; number <= 21; number++) {  // dimension, ranks, newton, boundaries
      std::int32_t any;
      if (!flag(number) || !value(any)) return false;
    }
    if (!text(22, style)) return false;
    // hybrid: more words follow
    return style.compare(0, 6, "hybrid") == 0 || (flag(23) && value(grains) && grains >= 0);
  }

 private:
  std::FILE *file_;

  template <class T>
  bool value(T &one) {
    return std::fread(&one, sizeof one, 1, file_) == 1;
  }
  bool flag(std::int32_t expected) {
    std::int32_t found;
    return value(found) && found == expected;
  }
  bool text(std::int32_t expected, std::string &words) {
    std::int32_t n;
    if (!flag(expected) || !value(n) || n < 1 || n > 1000) return false;
    words.resize(n);
    return std::fread(&words[0], 1, n, file_) == static_cast<std::size_t>(n);
  }
};

bool find_seal(std::FILE *file, std::uint64_t length, Seal &seal) {
  if (length < sizeof seal) return false;
  std::fseek(file, length - sizeof seal, SEEK_SET);
  const bool found = std::fread(&seal, sizeof seal, 1, file) == 1 && !memcmp(seal.mark, mark, sizeof mark);
  std::rewind(file);
  return found;
}

/** Whether `sealer` stands in the file. */
bool names_sealer(std::FILE *file, std::uint64_t length) {
  const std::string name = sealer;
  std::string seam;
  bool found = false;
  std::rewind(file);
  read_bytes(file, length, [&](const char *bytes, std::size_t n) {
    seam.append(bytes, n);
    found = found || seam.find(name) != std::string::npos;
    seam.erase(0, seam.size() - std::min(seam.size(), name.size()));
  });
  return found;
}

}

std::string seal(const std::string &name) {
  const auto failed = [&name] { return "cannot seal restart file '" + name + "': " + std::strerror(errno); };
  File file(std::fopen(name.c_str(), "r+b"));
  if (!file) return failed();
  Seal seal;
  memcpy(seal.mark, mark, sizeof mark);
  seal.length = length_of(file.get());
  seal.format = format;
  boost::crc_32_type crc;
  if (!read_bytes(file.get(), seal.length, [&crc](const char *bytes, std::size_t n) { crc.process_bytes(bytes, n); }))
    return failed();
  seal.checksum = crc.checksum();
  std::fseek(file.get(), 0, SEEK_END);
  if (std::fwrite(&seal, sizeof seal, 1, file.get()) != 1 || std::fflush(file.get()) != 0 ||
      fsync(fileno(file.get())) != 0)
    return failed();
  return "";
}

Verdict examine(const std::string &name) {
  Verdict verdict;
  File file(std::fopen(name.c_str(), "rb"));
  if (!file) {
    verdict.reason = std::string("cannot be opened: ") + std::strerror(errno);
    return verdict;
  }
  const std::uint64_t length = length_of(file.get());
  Header header(file.get());
  const bool read = header.read();
  verdict.step = header.step;
  if (!read) {
    verdict.reason = length == 0 ? "is empty" : "is not a restart file, or its beginning is damaged";
    return verdict;
  }
  Seal seal;
  verdict.sealed = find_seal(file.get(), length, seal);
  if (!verdict.sealed) {
    verdict.whole = !names_sealer(file.get(), length) && length > least_per_grain * header.grains;
    if (!verdict.whole) verdict.reason = "is truncated or damaged: its seal is missing";
    return verdict;
  }
  boost::crc_32_type crc;
  const bool fits =
      seal.length == length - sizeof seal &&
      read_bytes(file.get(), seal.length, [&crc](const char *bytes, std::size_t n) { crc.process_bytes(bytes, n); }) &&
      crc.checksum() == seal.checksum;
  if (!fits) verdict.reason = "is damaged: it does not match its seal";
  else if (seal.format != format)
    verdict.reason = "was written by a version of grainscope with format " + std::to_string(seal.format) +
                     ", this one has format " + std::to_string(format);
  verdict.whole = verdict.reason.empty();
  return verdict;
}

}}
