#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

/// A YAML document as a tree, by libyaml, which PETSc brings along.
namespace slipscale::yaml {

struct Node;
using NodePointer = std::shared_ptr<const Node>;

struct Node {
  enum class Kind { scalar, list, map } kind = Kind::scalar;
  std::string text;    ///< of a scalar
  bool plain = false;  ///< a scalar without quotes, which YAML may take for more than a text
  int line = 0;        ///< where it begins, from 1
  int levels = 0;      ///< of lists and maps, itself included; those that stand here by an alias count too
  std::vector<NodePointer> items;
  std::vector<std::pair<NodePointer, NodePointer>> pairs;
};

/// What is wrong with the text, after the name of the file; {} stands for the place. Line 0 is unknown.
struct Fault {
  std::string sentence;
  int line = 0;
};

/// The one document of the text; null when it is empty. Throws `Fault`.
NodePointer parse(const std::string& text);

}  // namespace slipscale::yaml
