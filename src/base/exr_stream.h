// An OpenEXR file in memory. OpenEXR's own output files finish in their destructor, which hides a full disk; writing to
// memory first and then with `write_file` does not.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <algorithm>
#include <string>

namespace redmap {

class ExrMemoryStream : public Imf::OStream {
 public:
  explicit ExrMemoryStream(const std::string& name) : Imf::OStream(name.c_str()) {}

  void write(const char bytes[], int count) override {
    bytes_.resize(std::max(bytes_.size(), position_ + count));
    std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ += count;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  /// The file, once the OpenEXR object that writes it is gone.
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace redmap
