// The Python program python/redmap/materialx.py, as a text. Not part of the public interface.
#pragma once

namespace redmap {

const char* materialx_script();

}  // namespace redmap
