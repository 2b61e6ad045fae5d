#pragma once

#include <string>
#include <vector>

#include "slipscale/record/fields_file.hpp"

namespace slipscale {

/// The whole of fields.xdmf for the given frames. Every frame repeats the references to the mesh, which all
/// readers take: ParaView's two and meshio's TimeSeriesReader.
std::string xdmf_text(const XdmfLayout& layout, const std::vector<double>& times);

}  // namespace slipscale
