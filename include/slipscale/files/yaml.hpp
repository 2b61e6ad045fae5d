#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace slipscale {

/// A YAML text of nested keys and plain values, in the order written; read alike by PETSc and by Python's
/// yaml.
class Yaml {
 public:
  /// A line of comment.
  Yaml& remark(const std::string& text);
  /// `key: value  # comment`; the text is quoted where YAML would take it for something else.
  Yaml& text(const std::string& key, const std::string& value, const std::string& comment = "");
  /// A value that is YAML already, a list say.
  Yaml& line(const std::string& key, const std::string& value, const std::string& comment);
  /// A number for people, six digits.
  Yaml& number(const std::string& key, double value, const std::string& comment = "");
  /// A number that is read back as the same double.
  Yaml& exact(const std::string& key, double value, const std::string& comment = "");
  Yaml& integer(const std::string& key, std::int64_t value, const std::string& comment = "");
  /// A flat list of numbers for people.
  Yaml& numbers(const std::string& key, const std::vector<double>& values, const std::string& comment = "");
  /// Keys up to the matching `end` are nested below `key`.
  Yaml& begin(const std::string& key, const std::string& comment = "");
  Yaml& end();

  const std::string& str() const { return text_; }

 private:
  std::string text_;
  int depth_ = 0;
};

/// The text of run.yaml: every effective option by its flat name, so that `-options_file_yaml run.yaml` runs
/// it again, and what `facts` writes (the version, ranks, stable step, …) nested under `run`, which is no
/// option.
std::string run_yaml(const std::map<std::string, std::string>& effective,
                     const std::function<void(Yaml& yaml)>& facts);

}  // namespace slipscale
