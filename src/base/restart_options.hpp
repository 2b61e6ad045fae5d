#pragma once

#include <string>
#include <vector>

#include "slipscale/base/program.hpp"

namespace slipscale {

/// What was in effect in the run that `restart` names, as if written before everything else; its folder is
/// the one that is named now. Throws UserError. Collective.
std::vector<Written> options_of_run(const RestartRule& rule, const Written& restart);

/// Throws UserError when one of PETSc's own files or variables has -restart, which is read before them.
void refuse_restart_elsewhere(const std::vector<Written>& options);

/// Throws UserError where an option is written now that may not change and does not say what `before` says;
/// names that `schema` does not know are left to others.
void refuse_changes(const std::vector<Written>& before, const std::vector<Written>& now,
                    const RestartRule& rule, const Schema& schema, const std::string& folder);

}  // namespace slipscale
