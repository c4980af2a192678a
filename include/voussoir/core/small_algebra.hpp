// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

/// Sums and products of vectors and matrices of fixed size, by plain loops, as values.
///
/// Eigen forms a type of its own for every expression, and the compiler pays for each: with them
/// the headers take twice as long to compile. Code inside namespace voussoir finds these operators
/// first for whole vectors and matrices; anything else (vectors of dynamic size, blocks of a
/// matrix, arrays) goes to Eigen as before, and so does all code outside.
namespace voussoir {

/// A matrix of fixed size, stored by columns; Fixed<n, 1> is a vector.
template <int Rows, int Cols>
using Fixed = Eigen::Matrix<double, Rows, Cols>;

template <class Scalar>
concept Arithmetic = std::is_arithmetic_v<Scalar>;

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator+(
    const Fixed<Rows, Cols>& a, const Fixed<Rows, Cols>& b) {
  Fixed<Rows, Cols> sum;
  for (int k = 0; k < Rows * Cols; ++k) sum.data()[k] = a.data()[k] + b.data()[k];
  return sum;
}

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator-(
    const Fixed<Rows, Cols>& a, const Fixed<Rows, Cols>& b) {
  Fixed<Rows, Cols> difference;
  for (int k = 0; k < Rows * Cols; ++k) difference.data()[k] = a.data()[k] - b.data()[k];
  return difference;
}

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator-(
    const Fixed<Rows, Cols>& a) {
  Fixed<Rows, Cols> opposite;
  for (int k = 0; k < Rows * Cols; ++k) opposite.data()[k] = -a.data()[k];
  return opposite;
}

template <Arithmetic Scalar, int Rows, int Cols>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator*(
    Scalar factor, const Fixed<Rows, Cols>& a) {
  Fixed<Rows, Cols> product;
  for (int k = 0; k < Rows * Cols; ++k)
    product.data()[k] = static_cast<double>(factor) * a.data()[k];
  return product;
}

template <int Rows, int Cols, Arithmetic Scalar>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator*(
    const Fixed<Rows, Cols>& a, Scalar factor) {
  return factor * a;
}

template <int Rows, int Cols, Arithmetic Scalar>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator/(
    const Fixed<Rows, Cols>& a, Scalar divisor) {
  Fixed<Rows, Cols> quotient;
  for (int k = 0; k < Rows * Cols; ++k)
    quotient.data()[k] = a.data()[k] / static_cast<double>(divisor);
  return quotient;
}

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) inline Fixed<Rows, Cols>& operator+=(Fixed<Rows, Cols>& a,
                                                                    const Fixed<Rows, Cols>& b) {
  for (int k = 0; k < Rows * Cols; ++k) a.data()[k] += b.data()[k];
  return a;
}

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) inline Fixed<Rows, Cols>& operator-=(Fixed<Rows, Cols>& a,
                                                                    const Fixed<Rows, Cols>& b) {
  for (int k = 0; k < Rows * Cols; ++k) a.data()[k] -= b.data()[k];
  return a;
}

template <int Rows, int Cols, Arithmetic Scalar>
requires(Rows > 0 && Cols > 0) inline Fixed<Rows, Cols>& operator*=(Fixed<Rows, Cols>& a,
                                                                    Scalar factor) {
  for (int k = 0; k < Rows * Cols; ++k) a.data()[k] *= static_cast<double>(factor);
  return a;
}

template <int Rows, int Cols, Arithmetic Scalar>
requires(Rows > 0 && Cols > 0) inline Fixed<Rows, Cols>& operator/=(Fixed<Rows, Cols>& a,
                                                                    Scalar divisor) {
  for (int k = 0; k < Rows * Cols; ++k) a.data()[k] /= static_cast<double>(divisor);
  return a;
}

template <int Rows, int Cols>
requires(Rows > 0 && Cols > 0) [[nodiscard]] inline bool operator==(const Fixed<Rows, Cols>& a,
                                                                    const Fixed<Rows, Cols>& b) {
  for (int k = 0; k < Rows * Cols; ++k)
    if (a.data()[k] != b.data()[k]) return false;
  return true;
}

template <int Rows, int Inner, int Cols>
requires(Rows > 0 && Inner > 0 && Cols > 0) [[nodiscard]] inline Fixed<Rows, Cols> operator*(
    const Fixed<Rows, Inner>& a, const Fixed<Inner, Cols>& b) {
  Fixed<Rows, Cols> product;
  const double* const left = a.data();
  for (int c = 0; c < Cols; ++c) {
    const double* const right = b.data() + c * Inner;
    double* const column = product.data() + c * Rows;
    for (int r = 0; r < Rows; ++r) column[r] = left[r] * right[0];
    for (int k = 1; k < Inner; ++k)
      for (int r = 0; r < Rows; ++r) column[r] += left[k * Rows + r] * right[k];
  }
  return product;
}
/// Of two rotations in 2-D; g++ 12 would call a function for these four sums.
template <int Size>
requires(Size == 2) [[nodiscard, gnu::always_inline]] inline Fixed<Size, Size> operator*(
    const Fixed<Size, Size>& a, const Fixed<Size, Size>& b) {
  const double *l = a.data(), *r = b.data();
  Fixed<Size, Size> product;
  product.data()[0] = l[0] * r[0] + l[2] * r[1];
  product.data()[1] = l[1] * r[0] + l[3] * r[1];
  product.data()[2] = l[0] * r[2] + l[2] * r[3];
  product.data()[3] = l[1] * r[2] + l[3] * r[3];
  return product;
}

template <int Size>
[[nodiscard]] inline double dot_product(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  double sum = a.data()[0] * b.data()[0];
  for (int k = 1; k < Size; ++k) sum += a.data()[k] * b.data()[k];
  return sum;
}
template <int Size>
[[nodiscard]] inline double squared_length_of(const Fixed<Size, 1>& a) {
  return dot_product(a, a);
}
template <int Size>
[[nodiscard]] inline double length_of(const Fixed<Size, 1>& a) {
  return std::sqrt(squared_length_of(a));
}
/// The vector of length 1 in the same direction; 0 and what is not a number stay as they are.
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> normalized(const Fixed<Size, 1>& a) {
  const double squared = squared_length_of(a);
  return squared > 0 ? a / std::sqrt(squared) : a;
}

template <int Rows, int Cols>
[[nodiscard]] inline Fixed<Cols, Rows> transposed(const Fixed<Rows, Cols>& a) {
  Fixed<Cols, Rows> turned_over;
  for (int c = 0; c < Cols; ++c)
    for (int r = 0; r < Rows; ++r) turned_over.data()[r * Cols + c] = a.data()[c * Rows + r];
  return turned_over;
}

/// `Size` entries of an array as a vector.
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> vector_at(const double* entries) {
  Fixed<Size, 1> vector;
  for (int k = 0; k < Size; ++k) vector.data()[k] = entries[k];
  return vector;
}
/// `Size` entries of a vector from entry `first` on.
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> part(const Eigen::VectorXd& vector, Eigen::Index first) {
  return vector_at<Size>(vector.data() + first);
}
template <int Size, int Of>
[[nodiscard]] inline Fixed<Size, 1> part(const Fixed<Of, 1>& vector, int first) {
  return vector_at<Size>(vector.data() + first);
}

template <int Size>
inline void write_at(double* entries, const Fixed<Size, 1>& vector) {
  for (int k = 0; k < Size; ++k) entries[k] = vector.data()[k];
}
template <int Size>
inline void add_at(double* entries, const Fixed<Size, 1>& vector) {
  for (int k = 0; k < Size; ++k) entries[k] += vector.data()[k];
}
template <int Size>
inline void set_part(Eigen::VectorXd& vector, Eigen::Index first, const Fixed<Size, 1>& part) {
  write_at<Size>(vector.data() + first, part);
}

/// Whether every entry of a is below (not above) that of b; false where one is not a number.
template <int Size>
[[nodiscard]] inline bool all_less(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  for (int k = 0; k < Size; ++k)
    if (!(a.data()[k] < b.data()[k])) return false;
  return true;
}
template <int Size>
[[nodiscard]] inline bool all_less_equal(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  for (int k = 0; k < Size; ++k)
    if (!(a.data()[k] <= b.data()[k])) return false;
  return true;
}
template <int Size>
[[nodiscard]] inline bool any_less(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  for (int k = 0; k < Size; ++k)
    if (a.data()[k] < b.data()[k]) return true;
  return false;
}
template <int Rows, int Cols>
[[nodiscard]] inline bool is_finite(const Fixed<Rows, Cols>& a) {
  for (int k = 0; k < Rows * Cols; ++k)
    if (!std::isfinite(a.data()[k])) return false;
  return true;
}
[[nodiscard]] inline bool is_finite(const Eigen::VectorXd& a) {
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if (!std::isfinite(a.data()[k])) return false;
  return true;
}
template <int Size>
[[nodiscard]] inline bool is_zero(const Fixed<Size, 1>& a) {
  for (int k = 0; k < Size; ++k)
    if (!(a.data()[k] == 0)) return false;
  return true;
}

/// Entry by entry: the smaller, the larger, the magnitude, the product, the sum with one number.
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> smaller_of(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  Fixed<Size, 1> low;
  for (int k = 0; k < Size; ++k)
    low.data()[k] = b.data()[k] < a.data()[k] ? b.data()[k] : a.data()[k];
  return low;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> larger_of(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  Fixed<Size, 1> high;
  for (int k = 0; k < Size; ++k)
    high.data()[k] = a.data()[k] < b.data()[k] ? b.data()[k] : a.data()[k];
  return high;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> magnitudes(const Fixed<Size, 1>& a) {
  Fixed<Size, 1> positive;
  for (int k = 0; k < Size; ++k) positive.data()[k] = std::abs(a.data()[k]);
  return positive;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> scaled_by(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  Fixed<Size, 1> products;
  for (int k = 0; k < Size; ++k) products.data()[k] = a.data()[k] * b.data()[k];
  return products;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> quotients(const Fixed<Size, 1>& a, const Fixed<Size, 1>& b) {
  Fixed<Size, 1> each;
  for (int k = 0; k < Size; ++k) each.data()[k] = a.data()[k] / b.data()[k];
  return each;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> shifted_by(const Fixed<Size, 1>& a, double shift) {
  Fixed<Size, 1> sums;
  for (int k = 0; k < Size; ++k) sums.data()[k] = a.data()[k] + shift;
  return sums;
}
template <int Size>
[[nodiscard]] inline double largest_entry(const Fixed<Size, 1>& a) {
  double largest = a.data()[0];
  for (int k = 1; k < Size; ++k)
    if (a.data()[k] > largest) largest = a.data()[k];
  return largest;
}
template <int Size>
[[nodiscard]] inline double smallest_entry(const Fixed<Size, 1>& a) {
  double smallest = a.data()[0];
  for (int k = 1; k < Size; ++k)
    if (a.data()[k] < smallest) smallest = a.data()[k];
  return smallest;
}
template <int Size>
[[nodiscard]] inline double product_of_entries(const Fixed<Size, 1>& a) {
  double product = a.data()[0];
  for (int k = 1; k < Size; ++k) product *= a.data()[k];
  return product;
}

template <int Rows, int Cols>
[[nodiscard]] inline Fixed<Rows, 1> column(const Fixed<Rows, Cols>& a, int c) {
  return vector_at<Rows>(a.data() + c * Rows);
}
template <int Rows, int Cols>
[[nodiscard]] inline Fixed<Cols, 1> row(const Fixed<Rows, Cols>& a, int r) {
  Fixed<Cols, 1> entries;
  for (int c = 0; c < Cols; ++c) entries.data()[c] = a.data()[c * Rows + r];
  return entries;
}
template <int Rows, int Cols>
inline void set_column(Fixed<Rows, Cols>& a, int c, const Fixed<Rows, 1>& entries) {
  write_at<Rows>(a.data() + c * Rows, entries);
}
template <int Rows, int Cols>
inline void set_row(Fixed<Rows, Cols>& a, int r, const Fixed<Cols, 1>& entries) {
  for (int c = 0; c < Cols; ++c) a.data()[c * Rows + r] = entries.data()[c];
}
/// A matrix from its entries, row by row, as on paper.
template <int Rows, int Cols>
[[nodiscard]] inline Fixed<Rows, Cols> by_rows(const double (&entries)[Rows * Cols]) {
  Fixed<Rows, Cols> a;
  for (int r = 0; r < Rows; ++r)
    for (int c = 0; c < Cols; ++c) a.data()[c * Rows + r] = entries[r * Cols + c];
  return a;
}
/// The vector along axis k of length 1, and one of equal entries.
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> axis_vector(int k) {
  Fixed<Size, 1> along;
  for (int i = 0; i < Size; ++i) along.data()[i] = i == k ? 1.0 : 0.0;
  return along;
}
template <int Size>
[[nodiscard]] inline Fixed<Size, 1> all_entries(double value) {
  Fixed<Size, 1> constant;
  for (int k = 0; k < Size; ++k) constant.data()[k] = value;
  return constant;
}
/// A vector or matrix of zeros: `zeros<Vec3>()`.
template <class Matrix>
[[nodiscard]] inline Matrix zeros() {
  Matrix zero;
  for (int k = 0; k < zero.size(); ++k) zero.data()[k] = 0;
  return zero;
}
/// One vector below another.
template <int Upper, int Lower>
[[nodiscard]] inline Fixed<Upper + Lower, 1> stacked(const Fixed<Upper, 1>& upper,
                                                     const Fixed<Lower, 1>& lower) {
  Fixed<Upper + Lower, 1> both;
  write_at<Upper>(both.data(), upper);
  write_at<Lower>(both.data() + Upper, lower);
  return both;
}
template <int Lower>
[[nodiscard]] inline Fixed<1 + Lower, 1> stacked(double first, const Fixed<Lower, 1>& lower) {
  Fixed<1 + Lower, 1> both;
  both.data()[0] = first;
  write_at<Lower>(both.data() + 1, lower);
  return both;
}
/// The block of a matrix with its upper left corner at (r, c).
template <int Rows, int Cols, int OfRows, int OfCols>
[[nodiscard]] inline Fixed<Rows, Cols> block_at(const Fixed<OfRows, OfCols>& a, int r, int c) {
  Fixed<Rows, Cols> block;
  for (int k = 0; k < Cols; ++k)
    for (int i = 0; i < Rows; ++i) block.data()[k * Rows + i] = a.data()[(c + k) * OfRows + r + i];
  return block;
}
template <int Rows, int Cols, int OfRows, int OfCols>
inline void set_block(Fixed<OfRows, OfCols>& a, int r, int c, const Fixed<Rows, Cols>& block) {
  for (int k = 0; k < Cols; ++k)
    for (int i = 0; i < Rows; ++i) a.data()[(c + k) * OfRows + r + i] = block.data()[k * Rows + i];
}
/// a b^T
template <int Rows, int Cols>
[[nodiscard]] inline Fixed<Rows, Cols> outer(const Fixed<Rows, 1>& a, const Fixed<Cols, 1>& b) {
  Fixed<Rows, Cols> product;
  for (int c = 0; c < Cols; ++c)
    for (int r = 0; r < Rows; ++r) product.data()[c * Rows + r] = a.data()[r] * b.data()[c];
  return product;
}
/// target -= a b
template <int Rows, int Inner, int Cols>
inline void subtract_product(Fixed<Rows, Cols>& target, const Fixed<Rows, Inner>& a,
                             const Fixed<Inner, Cols>& b) {
  target -= a * b;
}
/// target -= a b^T
template <int Rows, int Inner, int Cols>
inline void subtract_product_transposed(Fixed<Rows, Cols>& target, const Fixed<Rows, Inner>& a,
                                        const Fixed<Cols, Inner>& b) {
  // By columns in a local copy: the compiler keeps it in registers, which it may not do with the
  // target, for all it knows that could be a or b.
  for (int c = 0; c < Cols; ++c) {
    double column[Rows];
    for (int r = 0; r < Rows; ++r) column[r] = target.data()[c * Rows + r];
    for (int k = 0; k < Inner; ++k)
      for (int r = 0; r < Rows; ++r) column[r] -= a.data()[k * Rows + r] * b.data()[k * Cols + c];
    for (int r = 0; r < Rows; ++r) target.data()[c * Rows + r] = column[r];
  }
}
/// a^T b
template <int Inner, int Rows, int Cols>
[[nodiscard]] inline Fixed<Rows, Cols> transposed_product(const Fixed<Inner, Rows>& a,
                                                          const Fixed<Inner, Cols>& b) {
  Fixed<Rows, Cols> product;
  for (int c = 0; c < Cols; ++c)
    for (int r = 0; r < Rows; ++r) {
      double sum = a.data()[r * Inner] * b.data()[c * Inner];
      for (int k = 1; k < Inner; ++k) sum += a.data()[r * Inner + k] * b.data()[c * Inner + k];
      product.data()[c * Rows + r] = sum;
    }
  return product;
}
/// `factor` times the unit matrix.
template <int Size>
[[nodiscard]] inline Fixed<Size, Size> diagonal_of(double factor) {
  Fixed<Size, Size> diagonal;
  for (int k = 0; k < Size * Size; ++k) diagonal.data()[k] = k % (Size + 1) == 0 ? factor : 0.0;
  return diagonal;
}

}  // namespace voussoir
