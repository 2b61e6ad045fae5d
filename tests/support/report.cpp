#include "report.hpp"

#include "slipscale/base/print.hpp"

namespace slipscale::testing_support {

void report(const Finding& finding) {
  const std::string order = finding.order.empty() ? "-" : finding.order;
  print("verification | " + finding.topic + " | " + finding.quantity + " | " + finding.expected + " | " +
        finding.found + " | " + order + " | " + finding.source + "\n");
}

}  // namespace slipscale::testing_support
