#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "slipscale/relocalize/fields_reader.hpp"
#include "slipscale/relocalize/relocalisation.hpp"
#include "slipscale/relocalize/relocalisation_choice.hpp"
#include "slipscale/relocalize/relocalised_statistics.hpp"
#include "slipscale/relocalize/statistics_reader.hpp"

namespace slipscale {

/// What is read of other programs. Its members are collective.
struct RelocalisationSources {
  FieldsReader run;                       ///< the homogeneous one
  LocalisationTensors tensors;            ///< of the microstructure
  std::optional<FieldsReader> reference;  ///< the heterogeneous run, where there is one
  std::optional<StatisticsReader> statistics, reference_statistics;  ///< of both, where both have some
  std::optional<StrainStatistics> mean_strain;                       ///< of `statistics`

  /// Throws UserError when one is missing, damaged or incomplete, and when the two statistics are those of
  /// different windows.
  RelocalisationSources(MPI_Comm comm, const RelocalisationChoice& choice);

  /// The cells on which stresses are relocalised: copies of the micro mesh, or those of the reference.
  Targets targets(const RelocalisationChoice& choice) const;
};

/// What is doubtful or does not fit together though it can be worked with, a sentence each: materials of the
/// runs that homogenize was not content with; the material of a run and that
/// of the tensors, as stress and strain of a frame tell it; the scenes of the two runs; the meshes of the
/// tensors of a whole block and of the reference; missing statistics.
std::vector<std::string> misfits(MPI_Comm comm, const RelocalisationSources& sources);

/// A strip has to end at the contact, and there in a straight edge: UserError where frames leave the contact
/// out (-fields_box) or tiles overhang.
void refuse_strip_off_contact(const FieldsReader& run, const Targets& targets);

}  // namespace slipscale
