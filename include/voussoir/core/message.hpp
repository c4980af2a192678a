// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <voussoir/core/bodies.hpp>
#include <voussoir/core/message_number.hpp>

namespace voussoir {

/// A piece of a message: words, a whole number, or any number, written as `message_number` does. It
/// refers to the words it was made from.
struct MessagePiece {
  MessagePiece(const char* text) : kind(Kind::literal), literal(text) {}
  MessagePiece(const std::string& text) : kind(Kind::words), words(&text) {}
  MessagePiece(double value) : kind(Kind::number), number(value) {}
  template <std::integral Whole>
  MessagePiece(Whole value) : kind(Kind::whole), whole(static_cast<long long>(value)) {}

  enum class Kind { literal, words, number, whole } kind;
  union {
    const char* literal;
    const std::string* words;
    double number;
    long long whole;
  };
};

/// Put together by one function for all messages: a chain of operator+ is a dozen calls, and what
/// they clear up, in every function that may refuse something.
///
///   throw InvalidInput(message({"joint ", k, " of set ", set, ": must be finite"}));
[[nodiscard]] VOUSSOIR_INLINE std::string message(std::initializer_list<MessagePiece> pieces);

#if VOUSSOIR_BODIES

VOUSSOIR_INLINE std::string message(std::initializer_list<MessagePiece> pieces) {
  std::string text;
  for (const MessagePiece& piece : pieces) switch (piece.kind) {
      case MessagePiece::Kind::literal:
        text += piece.literal;
        break;
      case MessagePiece::Kind::words:
        text += *piece.words;
        break;
      case MessagePiece::Kind::number:
        text += message_number(piece.number);
        break;
      case MessagePiece::Kind::whole:
        text += std::to_string(piece.whole);
        break;
    }
  return text;
}

#endif

}  // namespace voussoir
