#pragma once

#include <string>

#include "slipscale/morphology/composite_mesh.hpp"

namespace slipscale {

/// Writes the regions in colour as a PNG, the longer side 1200 pixels; the edges of the cells are drawn where
/// they are at least 6 pixels apart. Throws LibraryError.
void write_picture(const CompositeMesh& mesh, const std::string& path);

}  // namespace slipscale
