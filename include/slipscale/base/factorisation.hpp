#pragma once

#include <petscksp.h>

namespace slipscale {

/// After KSPSetUp: whether a factorisation by MUMPS ran out of the workspace that its analysis had foreseen
/// (INFOG(1) −8 and −9). It then has twice as much (ICNTL(14)) and must be set up again:
///
///     do petsc(KSPSetUp(ksp)); while (enlarge_workspace(ksp));
///
/// False as well when that has been tried often enough. Collective.
bool enlarge_workspace(KSP ksp);

}  // namespace slipscale
