// SPDX-License-Identifier: MIT
#pragma once

#include <voussoir/core/errors.hpp>

namespace voussoir {

/// A stiffness matrix has a body, alone or with others, that can move without resistance.
class FreeBody : public NumericalFault {
 public:
  explicit FreeBody(int body)
      : NumericalFault(message({"elastic stiffness: body ", body, " can move without resistance"})),
        body_(body) {}

  /// Its block row.
  [[nodiscard]] int body() const { return body_; }

 private:
  int body_;
};

}  // namespace voussoir
