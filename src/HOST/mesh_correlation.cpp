// SPDX-License-Identifier: GPL-2.0-or-later
#include "mesh_correlation.h"
#include <algorithm>
#include <cstddef>
#include <fftw3-mpi.h>
#include <numeric>
#include <vector>

namespace grainscope {

namespace {

class FftwCorrelation : public MeshCorrelation {
 public:
  explicit FftwCorrelation(MPI_Comm world);
  ~FftwCorrelation() override;
  FftwCorrelation(const FftwCorrelation &) = delete;
  FftwCorrelation &operator=(const FftwCorrelation &) = delete;

  PairSums pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins,
                     const std::array<int, 3> &size) override;
  double memory_usage() const override { return numbers_ * sizeof(double); }

 private:
  struct Deposit {
    std::ptrdiff_t cell;  // in the slab of the rank that it is sent to
    double value;
  };

  MPI_Comm world_;
  int ranks_;
  LagMesh mesh_{{{0, 0, 0}}, 0, 0, 0};
  std::ptrdiff_t numbers_ = 0;  // room for the slab and its transform
  std::ptrdiff_t modes_ = 0;    // of the transform on this rank
  double *field_ = nullptr;
  fftw_plan forward_ = nullptr, backward_ = nullptr;
  std::vector<int> owner_;             // rank of each plane
  std::vector<std::ptrdiff_t> first_;  // plane of each rank

  void plan(const std::array<int, 3> &size);
  void clear();
  std::vector<Deposit> slab_deposits(const PointValues &points) const;
  void autocorrelate();
};

FftwCorrelation::FftwCorrelation(MPI_Comm world) : world_(world) {
  MPI_Comm_size(world, &ranks_);
  static const bool ready = (fftw_mpi_init(), true);
  static_cast<void>(ready);
}

FftwCorrelation::~FftwCorrelation() { clear(); }

void FftwCorrelation::clear() {
  if (forward_) fftw_destroy_plan(forward_);
  if (backward_) fftw_destroy_plan(backward_);
  if (field_) fftw_free(field_);
  forward_ = backward_ = nullptr;
  field_ = nullptr;
}

/** Plans by estimate: measured ones would differ from run to run in the last digits. */
void FftwCorrelation::plan(const std::array<int, 3> &size) {
  if (size == mesh_.size) return;  // the same on all ranks: planning is collective
  clear();
  const std::ptrdiff_t half = size[2] / 2 + 1;
  std::ptrdiff_t transposed_planes, transposed_first;
  mesh_.size = size;
  mesh_.row = 2 * half;
  numbers_ = 2 * fftw_mpi_local_size_3d_transposed(size[0], size[1], half, world_, &mesh_.planes, &mesh_.first_plane,
                                                   &transposed_planes, &transposed_first);
  modes_ = transposed_planes * size[0] * half;
  field_ = fftw_alloc_real(numbers_);
  fftw_complex *modes = reinterpret_cast<fftw_complex *>(field_);
  forward_ = fftw_mpi_plan_dft_r2c_3d(size[0], size[1], size[2], field_, modes, world_,
                                      FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_OUT);
  backward_ = fftw_mpi_plan_dft_c2r_3d(size[0], size[1], size[2], modes, field_, world_,
                                       FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_IN);

  std::vector<std::ptrdiff_t> planes(ranks_);
  first_.resize(ranks_);
  MPI_Allgather(&mesh_.planes, sizeof(std::ptrdiff_t), MPI_BYTE, planes.data(), sizeof(std::ptrdiff_t), MPI_BYTE,
                world_);
  MPI_Allgather(&mesh_.first_plane, sizeof(std::ptrdiff_t), MPI_BYTE, first_.data(), sizeof(std::ptrdiff_t), MPI_BYTE,
                world_);
  owner_.assign(size[0], 0);
  for (int rank = 0; rank < ranks_; rank++)
    std::fill_n(owner_.begin() + (planes[rank] > 0 ? first_[rank] : 0), planes[rank], rank);
}

/** Sends the points to the ranks that hold their cells; returns what came for this one. */
std::vector<FftwCorrelation::Deposit> FftwCorrelation::slab_deposits(const PointValues &points) const {
  std::vector<std::vector<Deposit>> outgoing(ranks_);
  for (std::size_t i = 0; i < points.size(); i++) {
    const std::array<int, 3> cell = mesh_.cell_of(points, i);
    if (*std::min_element(cell.begin(), cell.end()) < 0) continue;
    const int rank = owner_[cell[0]];
    outgoing[rank].push_back(
        {(cell[0] - first_[rank]) * mesh_.size[1] * mesh_.row + mesh_.in_plane(cell), points.values[0][i]});
  }
  std::vector<int> sent(ranks_), received(ranks_), sent_at(ranks_), received_at(ranks_);
  for (int rank = 0; rank < ranks_; rank++) sent[rank] = static_cast<int>(outgoing[rank].size() * sizeof(Deposit));
  MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, world_);
  std::partial_sum(sent.begin(), sent.end() - 1, sent_at.begin() + 1);
  std::partial_sum(received.begin(), received.end() - 1, received_at.begin() + 1);
  std::vector<Deposit> packed, deposits((received_at.back() + received.back()) / sizeof(Deposit));
  for (const auto &part : outgoing) packed.insert(packed.end(), part.begin(), part.end());
  MPI_Alltoallv(packed.data(), sent.data(), sent_at.data(), MPI_BYTE, deposits.data(), received.data(),
                received_at.data(), MPI_BYTE, world_);
  return deposits;
}

/** Replaces the field by its sum over all cells of the product with itself at each lag. */
void FftwCorrelation::autocorrelate() {
  fftw_execute(forward_);
  const double scale = 1.0 / (static_cast<double>(mesh_.size[0]) * mesh_.size[1] * mesh_.size[2]);
  for (std::ptrdiff_t k = 0; k < modes_; k++) {
    double *mode = field_ + 2 * k;
    mode[0] = scale * (mode[0] * mode[0] + mode[1] * mode[1]);
    mode[1] = 0.0;
  }
  fftw_execute(backward_);
}

PairSums FftwCorrelation::pair_sums(const PeriodicCell &cell, const PointValues &points, const DistanceBins &bins,
                                    const std::array<int, 3> &size) {
  plan(size);
  const std::vector<Deposit> deposits = slab_deposits(points);
  PairSums sums(bins.count);
  for (const bool counting : {false, true}) {
    std::fill(field_, field_ + numbers_, 0.0);
    double itself = 0.0;  // what each point contributes with itself, at no distance
    for (const Deposit &d : deposits) {
      field_[d.cell] += counting ? 1.0 : d.value;
      itself += counting ? 1.0 : d.value * d.value;
    }
    autocorrelate();
    std::vector<double> &bin = counting ? sums.pairs : sums.products[0];
    add_lags(cell, mesh_, field_, counting, bins, bin);
    bin[0] -= itself;
    for (double &sum : bin) sum *= 0.5;  // each pair was met at a lag and at its opposite
  }
  return sums;
}

}

std::unique_ptr<MeshCorrelation> MeshCorrelation::make(MPI_Comm world) {
  return std::unique_ptr<MeshCorrelation>(new FftwCorrelation(world));
}

}
