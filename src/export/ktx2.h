// KTX 2.0 containers (Khronos, "KTX File Format Specification" 2.0): full mip chains of bytes, array textures.
#pragma once

#include <string>

#include "export/texture.h"

namespace redmap {

/// One, two or four channels; three become four, the last full, since devices know no three bytes. `rows_down`: rows
/// come from the top (v = 1) down, as glTF wants it, and not the other way round.
std::string ktx2_bytes(const Texture& texture, bool rows_down = true);

}  // namespace redmap
