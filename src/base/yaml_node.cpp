#include "yaml_node.hpp"

#include <yaml.h>

#include <algorithm>
#include <map>
#include <new>

namespace slipscale::yaml {
namespace {

/// What the programs write is three levels deep, and a person's file hardly deeper.
constexpr int most_levels = 50;

std::string text_of(const yaml_char_t* text) { return text ? reinterpret_cast<const char*>(text) : ""; }

class Parser {
 public:
  explicit Parser(const std::string& text) {
    if (!yaml_parser_initialize(&parser_)) throw std::bad_alloc();
    yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~Parser() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  NodePointer document() {
    advance();  // the stream begins
    advance();
    if (event_.type == YAML_STREAM_END_EVENT) return nullptr;
    advance();
    NodePointer root = node(0);
    advance();  // the document ends
    if (event_.type != YAML_STREAM_END_EVENT)
      throw Fault{"holds more than one YAML document{}; a scene is one, without a line of dashes between",
                  line()};
    return root;
  }

 private:
  int line() const { return static_cast<int>(event_.start_mark.line) + 1; }

  void advance() {
    yaml_event_delete(&event_);
    if (yaml_parser_parse(&parser_, &event_)) return;
    event_.type = YAML_NO_EVENT;
    if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
    const std::string cure = "; look at the indentation (blanks, no tabs), colons, quotes and brackets";
    if (parser_.error == YAML_READER_ERROR)
      throw Fault{"is not text in UTF-8{} (" +
                      text_of(reinterpret_cast<const yaml_char_t*>(parser_.problem)) + " at byte " +
                      std::to_string(parser_.problem_offset) + ")",
                  0};
    // Where a bracket, a quote or a key begins that never ends. A block goes wrong where it goes wrong.
    const std::string context = parser_.context ? parser_.context : "";
    const bool is_opening = !context.empty() && !context.starts_with("while parsing a block");
    const yaml_mark_t& mark = is_opening ? parser_.context_mark : parser_.problem_mark;
    throw Fault{"is not valid YAML{}" + cure, static_cast<int>(mark.line) + 1};
  }

  /// Of the event that stands; the next one stands afterwards.
  NodePointer node(int level) {
    if (level > most_levels) refuse_depth(line());
    switch (event_.type) {
      case YAML_ALIAS_EVENT: {
        const auto found = anchors_.find(text_of(event_.data.alias.anchor));
        if (found == anchors_.end())
          throw Fault{
              "refers to *" + text_of(event_.data.alias.anchor) + "{}, which nothing before it is called",
              line()};
        NodePointer known = found->second;
        advance();
        return known;
      }
      case YAML_SCALAR_EVENT:
        return scalar();
      case YAML_SEQUENCE_START_EVENT:
        return list(level);
      default:
        return map(level);
    }
  }

  [[noreturn]] static void refuse_depth(int line) {
    throw Fault{"is nested more than " + std::to_string(most_levels) + " levels deep{}; options need four",
                line};
  }

  /// Counted from below, because aliases may pile up what stands side by side.
  static void grow(Node& node, const Node& child) {
    node.levels = std::max(node.levels, 1 + child.levels);
    if (node.levels > most_levels) refuse_depth(node.line);
  }

  void refuse_tag(const yaml_char_t* tag) const {
    if (tag)
      throw Fault{"has a tag{} (" + text_of(tag) + "), which options cannot express; remove it", line()};
  }

  void name(const std::string& anchor, const NodePointer& made) {
    if (!anchor.empty()) anchors_[anchor] = made;
  }

  NodePointer scalar() {
    const auto& data = event_.data.scalar;
    refuse_tag(data.tag);
    auto made = std::make_shared<Node>();
    made->text.assign(reinterpret_cast<const char*>(data.value), data.length);
    made->plain = data.style == YAML_PLAIN_SCALAR_STYLE;
    made->line = line();
    if (made->text.find('\0') != std::string::npos)
      throw Fault{"has a NUL byte in a text{}; remove it", made->line};
    name(text_of(data.anchor), made);
    advance();
    return made;
  }

  NodePointer list(int level) {
    refuse_tag(event_.data.sequence_start.tag);
    auto made = std::make_shared<Node>();
    made->kind = Node::Kind::list;
    made->line = line();
    const std::string anchor = text_of(event_.data.sequence_start.anchor);
    advance();
    while (event_.type != YAML_SEQUENCE_END_EVENT) {
      made->items.push_back(node(level + 1));
      grow(*made, *made->items.back());
    }
    advance();
    name(anchor, made);
    return made;
  }

  NodePointer map(int level) {
    refuse_tag(event_.data.mapping_start.tag);
    auto made = std::make_shared<Node>();
    made->kind = Node::Kind::map;
    made->line = line();
    const std::string anchor = text_of(event_.data.mapping_start.anchor);
    advance();
    while (event_.type != YAML_MAPPING_END_EVENT) {
      NodePointer key = node(level + 1);
      made->pairs.emplace_back(std::move(key), node(level + 1));
      grow(*made, *made->pairs.back().first);
      grow(*made, *made->pairs.back().second);
    }
    advance();
    name(anchor, made);
    return made;
  }

  yaml_parser_t parser_{};
  yaml_event_t event_{};
  std::map<std::string, NodePointer> anchors_;
};

}  // namespace

NodePointer parse(const std::string& text) { return Parser(text).document(); }

}  // namespace slipscale::yaml
