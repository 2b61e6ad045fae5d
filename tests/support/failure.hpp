#pragma once

#include <string>

namespace slipscale::testing_support {

/// What the action says when it throws an `Error`; empty when it throws nothing.
template <class Error>
std::string failure_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace slipscale::testing_support
