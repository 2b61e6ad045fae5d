#pragma once

#include <cmath>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

inline Vector2 operator+(const Vector2& a, const Vector2& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline Vector2 operator-(const Vector2& a, const Vector2& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline Vector2 operator*(double s, const Vector2& a) { return {s * a[0], s * a[1]}; }
inline double dot(const Vector2& a, const Vector2& b) { return a[0] * b[0] + a[1] * b[1]; }
inline double cross(const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; }
/// A quarter turn counter-clockwise.
inline Vector2 turned(const Vector2& a) { return {-a[1], a[0]}; }
inline double norm(const Vector2& a) { return std::sqrt(dot(a, a)); }
inline Vector2 unit(const Vector2& a) { return (1 / norm(a)) * a; }
inline Vector2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace slipscale
