#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// Displacement [m] and velocity [m/s] at given places, as they come from a file.
struct NodalFields {
  std::vector<Vector2> displacement, velocity;  ///< [places]
  std::string description;                      ///< "frame of t = 2e-05 s of 'out/fields.h5'"
  std::uint64_t checksum = 0;                   ///< of what was read
};

/// A place outside of the cells of the file has the values of the nearest point of their rim as long as it is
/// no further away than this part of the extent of all of them: two meshes of one body differ by rounding, or
/// by the chords of a circle.
inline constexpr double nodal_fields_reach = 1e-6;

/// Reads `path` and interpolates with the shape functions of its cells. It is a fields.h5 of `slide`, or the
/// folder that it lies in: the frame of `time`, the last one without; or a table, `*.csv`: a line that names
/// the columns x, y [m] and any of ux (or u), uy (or v) [m], vx, vy [m/s], then one line a point. Its points
/// make a grid, every x with every y, between which it is bilinear; columns that it has not are zero.
/// `option` led here, `time_option` gives the time. Every rank reads all of it, so that values do not depend
/// on the number of ranks. Throws UserError for a file that is neither, a time without frame, and a place
/// outside, with its distance. Collective.
NodalFields read_nodal_fields(MPI_Comm comm, const std::string& path, const std::string& option,
                              const std::optional<double>& time, const std::string& time_option,
                              const std::vector<Vector2>& places);

}  // namespace slipscale
