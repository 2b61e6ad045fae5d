#include <unistd.h>

#include <cmath>
#include <new>

#include "gmsh_file.hpp"
#include "groups.hpp"
#include "periods.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/base/readable.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// Refuses to make more cells than can be numbered or held by one machine.
void check_refinement(std::size_t cells, int times) {
  const double finer = static_cast<double>(cells) * std::pow(4.0, times), bytes = 600 * finer,
               memory =
                   static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (finer > PETSC_MAX_INT / 4 || bytes > memory)
    throw UserError(
        format("-mesh_refine {} makes {:.3g} cells of {}, which take some {} of memory where this "
               "machine has {}; refine less",
               times, finer, cells, readable_bytes(bytes), readable_bytes(memory)));
}

void note_turned(const std::vector<int>& surfaces, std::vector<std::string>& notes) {
  if (surfaces.empty()) return;
  std::string list;
  for (std::size_t k = 0; k < std::min<std::size_t>(surfaces.size(), 8); ++k)
    list += (k ? ", " : "") + std::to_string(surfaces[k]);
  if (surfaces.size() > 8) list += format(" and {} more", surfaces.size() - 8);
  notes.push_back((surfaces.size() > 1 ? "surfaces " : "surface ") + list +
                  " of gmsh run clockwise and are turned");
}

/// All of it, on rank 0. Throws UserError and GmshFault.
void load(const MeshSource& source, Whole& whole) {
  GmshFile file = read_gmsh(source.file);
  if (source.cut_by_choice && !file.mesh.is_periodic)
    throw UserError("-mesh_periodic false has no effect: mesh '" + source.file +
                    "' is not periodic; leave the option out");
  whole.checksum = file.checksum;
  Groups groups = find_groups(file.mesh);
  whole.regions = std::move(groups.regions);
  whole.boundaries = std::move(groups.boundaries);
  whole.notes = std::move(groups.notes);
  if (file.mesh.is_of_higher_order)
    whole.notes.emplace_back("cells of higher order are taken as straight ones between their corners");
  note_turned(turn_clockwise_surfaces(file.mesh), whole.notes);
  for (std::string& note : whole.notes) note = "mesh '" + source.file + "': " + note;
  Periods periods;
  if (file.mesh.is_periodic && !source.cut) periods = periods_of(file.mesh);
  whole.plain = plain_mesh(file.mesh, periods.original, whole.regions, whole.boundaries);
  file.mesh = {};
  check_torus(whole.plain);
  if (source.refine > 0) check_refinement(whole.plain.cells.size(), source.refine);
  for (int k = 0; k < source.refine; ++k) whole.plain = refined(whole.plain);
  survey(whole);
  whole.around = cells_around(whole.plain.cells, whole.node_count);
  check_soundness(whole.plain, whole.around, periods.shifts);
  whole.edge_rounding = edge_rounding(whole.plain, whole.lower, whole.upper, whole.shortest_edge);
}

/// The sentence about what is wrong with the mesh, or nothing.
std::string fault_in_loading(const MeshSource& source, Whole& whole) {
  try {
    load(source, whole);
  } catch (const GmshFault& fault) {
    return sentence(source.file, fault.what());
  } catch (const UserError& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return sentence(source.file, "takes more memory than there is; mesh it coarser");
  }
  return "";
}

void broadcast(MPI_Comm comm, std::string& text) {
  auto size = static_cast<int>(text.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), size, MPI_CHAR, 0, comm);
}

/// Makes a list as long as that of rank 0.
template <class Entry>
void agree_on_length(MPI_Comm comm, std::vector<Entry>& list) {
  auto size = static_cast<int>(list.size());
  MPI_Bcast(&size, 1, MPI_INT, 0, comm);
  list.resize(static_cast<std::size_t>(size));
}

void tell_names(MPI_Comm comm, Whole& whole) {
  const auto tell = [&](auto& groups) {
    agree_on_length(comm, groups);
    for (auto& group : groups) {
      MPI_Bcast(&group.tag, 1, MPI_INT, 0, comm);
      broadcast(comm, group.name);
    }
  };
  tell(whole.regions);
  tell(whole.boundaries);
  agree_on_length(comm, whole.notes);
  for (std::string& note : whole.notes) broadcast(comm, note);
  MPI_Bcast(&whole.checksum, 1, MPI_UINT64_T, 0, comm);
}

void tell_sizes(MPI_Comm comm, Whole& whole) {
  std::vector<double> numbers;
  std::size_t next = 0;
  // The same list is walked twice: rank 0 writes it, the others read it.
  const auto exchange = [&](auto&& visit) {
    for (auto& r : whole.regions) visit(r.cells), visit(r.area);
    for (auto& b : whole.boundaries)
      visit(b.edge_count), visit(b.length), visit(b.interior), visit(b.normal[0]), visit(b.normal[1]);
    for (int k = 0; k < 2; ++k) visit(whole.periodic[k]), visit(whole.lower[k]), visit(whole.upper[k]);
    visit(whole.edge_rounding.quantum), visit(whole.edge_rounding.phase);
    visit(whole.shortest_edge), visit(whole.node_count), visit(whole.cell_count);
  };
  exchange([&](auto& value) { numbers.push_back(static_cast<double>(value)); });
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, comm);
  exchange(
      [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(numbers[next++]); });
}

}  // namespace

Whole load_whole(MPI_Comm comm, const MeshSource& source) {
  Whole whole;
  const bool root = is_root(comm);
  throw_together(comm, root ? fault_in_loading(source, whole) : "");
  tell_names(comm, whole);
  tell_sizes(comm, whole);
  if (root) number_whole(whole);
  return whole;
}

}  // namespace slipscale::mesh_stages
