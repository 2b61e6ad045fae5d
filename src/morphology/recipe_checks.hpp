#pragma once

#include <set>
#include <string>

#include "slipscale/morphology/recipe.hpp"

/// What a recipe must not say. All of it throws UserError.
namespace slipscale::morphology {

/// The families of -families_<family>_<key> that count, known to `options` from here on. -shape and families
/// say the same in two ways: the later place has the last word.
std::set<std::string> read_family_names(Options& options);

/// A region is named in options and beside the sides of the block: the name must be one word, and its own.
void refuse_region_name(const std::string& name, const std::string& where, std::set<std::string>& taken);

/// Options that have no effect with what is drawn.
void refuse_idle_with(const Options& options, Composite composite, const std::set<std::string>& families);

/// Whether -cell grid is given, for a picture.
bool fits_image(const Options& options);

/// Options that have no effect with -cell grid.
void refuse_idle_with_grid(const Options& options);

/// Options of one kind of inclusion that have no effect with its shape or in an array.
void refuse_idle_inclusion(const Options& options, const std::string& prefix, Shape shape, bool in_array);

/// Edges of the mesh that are longer than what they are to divide.
void refuse_coarse(const Options& options, const Recipe& recipe);

}  // namespace slipscale::morphology
