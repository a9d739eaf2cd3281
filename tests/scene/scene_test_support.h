// What the scene tests share: files in a folder of their own, and error messages as a person would read them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/temporary_folder.h"

namespace redmap {

/// Writes `text` into the folder and returns the path.
inline std::filesystem::path write(const TemporaryFolder& folder, const std::string& name, std::string_view text) {
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

/// The message of the Error that `body` throws; "nothing was thrown" if it throws none.
template <typename Body>
std::string error_message(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

/// Whether `part` stands in `message`, which must be one line.
inline testing::AssertionResult mentions(std::string_view message, std::string_view part) {
  if (message.find('\n') != std::string_view::npos)
    return testing::AssertionFailure() << "more than one line: " << message;
  if (message.find(part) != std::string_view::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "expected \"" << part << "\" in \"" << message << "\"";
}

}  // namespace redmap
