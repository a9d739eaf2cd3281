#include "base/atomic_file.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "base/error.h"
#include "base/full_disk.h"
#include "base/temporary_folder.h"

namespace redmap {
namespace {

TEST(AtomicFile, WrittenBytes_ComeBack_AndNothingElseIsLeft) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\n", 4);
  write_file(folder / "file", bytes);
  EXPECT_EQ(read_file(folder / "file"), bytes);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, WithoutCommit_LeavesTheTargetAsItWas) {
  const TemporaryFolder folder;
  write_file(folder / "file", "old");
  {
    AtomicFile file(folder / "file");
    file.write("new");
    EXPECT_EQ(folder.entries(), 2u);
  }
  EXPECT_EQ(read_file(folder / "file"), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, BytesWrittenThroughItsPath_AreCommitted) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "file");
  std::FILE* other = std::fopen(file.path().c_str(), "wb");
  std::fputs("by name", other);
  std::fclose(other);
  file.commit();
  EXPECT_EQ(read_file(folder / "file"), "by name");
}

TEST(AtomicFile, ManyWritersOfOneTarget_LeaveOneWholeFile) {
  const TemporaryFolder folder;
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'i'; ++letter)
    writers.emplace_back([&folder, letter] { write_file(folder / "file", std::string(100000, letter)); });
  for (std::thread& writer : writers) writer.join();
  const std::string bytes = read_file(folder / "file");
  EXPECT_EQ(bytes, std::string(100000, bytes.at(0)));
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, MissingFolder_IsAnErrorThatNamesTheTarget) {
  const TemporaryFolder folder;
  try {
    write_file(folder / "no" / "file", "x");
    FAIL() << "expected an Error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no/file"), std::string::npos) << error.what();
  }
}

TEST(AtomicFile, FolderAsTarget_IsAnError) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "sub");
  EXPECT_THROW(write_file(folder / "sub", "x"), Error);
  EXPECT_THROW(read_file(folder / "sub"), Error);
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, FullDisk_IsAnError_AndNothingIsLeft) {
  const TemporaryFolder folder;
  const FullDisk disk(1000);
  EXPECT_NO_THROW(write_file(folder / "fits", std::string(900, 'x')));
  // The second fits into the buffer and fails only when that is emptied.
  EXPECT_THROW(write_file(folder / "large", std::string(1 << 20, 'x')), Error);
  EXPECT_THROW(write_file(folder / "buffered", std::string(1100, 'x')), Error);
  EXPECT_EQ(folder.entries(), 1u);
}

}  // namespace
}  // namespace redmap
