// Bitmaps of atlas cells: rows of 64-bit words, so that a row of a chart is compared with a row of the atlas in a few
// instructions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace redmap {

struct Cell {
  int x, y;
};

/// Rows of bits, each in whole words and one word of zeros.
class CellBitmap {
 public:
  CellBitmap() = default;
  CellBitmap(int width, int height)
      : width_(width), height_(height), words_(width / 64 + 2), bits_(std::size_t(words_) * height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  void set(int x, int y) { row(y)[x / 64] |= std::uint64_t{1} << (x % 64); }
  bool at(int x, int y) const { return row(y)[x / 64] >> (x % 64) & 1; }

  /// 64 bits of row y, from x on.
  std::uint64_t bits_from(int x, int y) const {
    const std::uint64_t* bits = row(y) + x / 64;
    return x % 64 == 0 ? bits[0] : bits[0] >> (x % 64) | bits[1] << (64 - x % 64);
  }

  bool collides(const CellBitmap& shape, int x, int y) const {
    for (int line = 0; line < shape.height_; ++line)
      for (int word = 0; word < shape.words_ && x / 64 + word < words_; ++word)
        if (row(y + line)[x / 64 + word] & shape.shifted_word(line, word, x % 64)) return true;
    return false;
  }

  void add(const CellBitmap& shape, int x, int y) {
    for (int line = 0; line < shape.height_; ++line)
      for (int word = 0; word < shape.words_ && x / 64 + word < words_; ++word)
        row(y + line)[x / 64 + word] |= shape.shifted_word(line, word, x % 64);
  }

 private:
  std::uint64_t* row(int y) { return bits_.data() + std::size_t(y) * words_; }
  const std::uint64_t* row(int y) const { return bits_.data() + std::size_t(y) * words_; }
  /// Word `word` of a row moved `shift` bits up.
  std::uint64_t shifted_word(int line, int word, int shift) const {
    const std::uint64_t* bits = row(line);
    const std::uint64_t carried = shift == 0 || word == 0 ? 0 : bits[word - 1] >> (64 - shift);
    return bits[word] << shift | carried;
  }

  int width_ = 0, height_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace redmap
