#include "recipe_checks.hpp"

#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::morphology {
namespace {

const std::string prefix = "-families_";

std::string folded(std::string word) {
  for (char& c : word)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return word;
}

/// The family of a typed -families_<family>_<key>; empty when no key stands at the end.
std::string family_in(const std::string& word) {
  std::size_t longest = 0;
  for (const Option& option : recipe_schema()) {
    const std::size_t end = option.name.find('>');
    if (!option.name.starts_with("families_") || end == std::string::npos) continue;
    const std::string key = option.name.substr(end + 1);
    if (word.ends_with(key)) longest = std::max(longest, key.size());
  }
  if (longest == 0 || word.size() <= prefix.size() + longest) return "";
  return word.substr(prefix.size(), word.size() - prefix.size() - longest);
}

/// To three digits, and down, so that what a message recommends is accepted.
std::string rounded_down(double x) {
  const double unit = std::pow(10, std::floor(std::log10(x)) - 2);
  return format("{:.3g}", std::floor(x / unit * (1 + 1e-12)) * unit);
}

void refuse_longer(double length, double most, const std::string& option, const std::string& fault) {
  if (length > most * (1 + 1e-9))
    throw UserError("-" + option + format(" {:g} ", length) + fault + "; give at most " + rounded_down(most));
}

/// The short axis of the inclusions, or the thinner layers; infinite when there is nothing to resolve, m.
double thinnest(const Recipe& recipe) {
  if (recipe.composite == Composite::laminate)
    return recipe.laminate.period * std::min(recipe.laminate.fraction, 1 - recipe.laminate.fraction);
  double least = INFINITY;
  for (const Family& family : recipe.families) {
    Inclusion unit{family.shape, {}, 0.5, 0.5 / family.aspect, family.rounding * 0.5 / family.aspect, 0, 0};
    double diameter = family.diameter;
    if (recipe.composite == Composite::array && diameter == 0)
      diameter = std::sqrt(family.fraction * recipe.room.block.width() * recipe.room.block.height() /
                           (recipe.array.columns * recipe.array.rows * area(unit)));
    least = std::min(least, diameter / family.aspect);
  }
  return least;
}

}  // namespace

std::set<std::string> read_family_names(Options& options) {
  std::set<std::string> typed, names, count, taken{"matrix", "homogenized"};
  for (const std::string& name : options.typed())
    if (name.starts_with(prefix.substr(1))) typed.insert("-" + name);
  for (const std::string& word : typed) {
    const std::string family = family_in(word);
    if (!family.empty()) names.insert(family);
  }
  for (const std::string& name : names) refuse_region_name(name, "the family", taken);
  options.know_names("family", {names.begin(), names.end()});  // knows the nearest key of a misspelt one
  for (const std::string& word : typed) {
    if (family_in(word).empty())
      throw UserError(word + " is not a key of a family, whose name is one word; see morphology -help");
    options.refuse_both("shape", word.substr(1));
    if (options.given(word.substr(1))) count.insert(family_in(word));
  }
  for (const std::string& name : names)
    if (!count.contains(name))
      options.refuse_idle(names_in(recipe_schema(), "families_", name),
                          {"beside a later -shape", "give it after -shape", {"shape"}});
  return count;
}

void refuse_region_name(const std::string& name, const std::string& where, std::set<std::string>& taken) {
  const std::string cure = "; choose another name";
  if (name.empty() || name.find_first_of(" \t,:#'\"") != std::string::npos)
    throw UserError(where + " '" + name +
                    "' has a name that no option can spell; use letters, digits, - and _");
  for (const char* side : {"bottom", "right", "top", "left"})
    if (folded(name) == side) throw UserError(where + " '" + name + "' has the name of a side" + cure);
  // Names that PETSc and slide keep for themselves.
  for (const char* word : {"all", "depth", "celltype", "vtk", "ghost", "dim", "pyre"})
    if (name == word)
      throw UserError(where + " '" + name + "' has a name with a meaning of its own in slide" + cure);
  if (!taken.insert(folded(name)).second)
    throw UserError(where + " '" + name + "' has the name of another region (capitals do not count)" + cure);
}

void refuse_coarse(const Options& options, const Recipe& recipe) {
  const MeshSize& size = recipe.mesh.size;
  for (int axis = 0; axis < 2; ++axis) {
    const double extent = axis == 0 ? recipe.room.block.width() : recipe.room.block.height();
    const std::string side = format("{} of the block ({:g} m)", axis == 0 ? "width" : "height", extent);
    refuse_longer(size.bulk, extent, "size", "is more than the " + side);
    if (recipe.room.periodic[axis])
      refuse_longer(size.bulk, extent / 3, "size",
                    "leaves fewer than three cells across the periodic " + side);
  }
  if (recipe.composite == Composite::laminate) {
    const double across = recipe.room.block.width() * std::abs(std::sin(recipe.laminate.angle)) +
                          recipe.room.block.height() * std::abs(std::cos(recipe.laminate.angle));
    refuse_longer(recipe.laminate.period, across, "layer_period",
                  format("is more than the block across the layers ({:g} m)", across));
  }
  const bool own = options.given("size_interface") && options.text("size_interface") != "auto";
  const std::string parts =
      recipe.composite == Composite::laminate ? "the thinner layers are thick" : "the inclusions are wide";
  refuse_longer(size.interface, thinnest(recipe), own ? "size_interface" : "size",
                "is more than " + parts + format(" ({:g} m)", thinnest(recipe)));
  refuse_longer(size.interface, size.bulk, "size_interface",
                format("is more than -size ({:g} m)", size.bulk));
  refuse_longer(size.surface, size.bulk, "size_surface", format("is more than -size ({:g} m)", size.bulk));
}

}  // namespace slipscale::morphology
