#pragma once

#include <Eigen/Dense>
#include <complex>
#include <vector>

#include "slipscale/dynamics/scene.hpp"

/// Steady sliding linearised with dense matrices of all components, without a basis and without the library's
/// assembly: what the modes are compared with.
namespace slipscale::testing_support {

struct DenseBody {
  Eigen::MatrixXd stiffness;    ///< of the free components, [free, free]
  Eigen::MatrixXd mass;         ///< [free, free]
  Eigen::MatrixXd damped;       ///< the part of the mass that -damping_mass acts on, without plates
  Eigen::MatrixXd reaction;     ///< λ = reaction u, [closed, free]
  Eigen::MatrixXd push;         ///< of friction forces on the free components, [free, closed]
  Eigen::VectorXd coefficient;  ///< μ(V) [closed]
  Eigen::VectorXd slope;        ///< μ'(V) λ of the steady state [closed], N s/m²
};

/// The whole body on every rank. `closed`: whole-mesh numbers of the closed nodes, `reactions` their λ, N/m.
/// Collective.
DenseBody dense_body(const Mesh& mesh, const std::vector<Material>& materials, const Scene& scene,
                     const std::vector<PetscInt>& closed, const std::vector<double>& reactions);

/// Eigenvalues p with Im p > 0 of u' = v, Mv' = −Ku − Cv + Bs, Ts' = −s + μ(λ(u) + bλ(v)) − μ'λ Bᵀv.
std::vector<std::complex<double>> exponents_of(const DenseBody& body, const Scene& scene, double time);

/// The same of one step of the β2 scheme, p = log z/Δt.
std::vector<std::complex<double>> scheme_exponents_of(const DenseBody& body, const Scene& scene, double time,
                                                      double step);

}  // namespace slipscale::testing_support
