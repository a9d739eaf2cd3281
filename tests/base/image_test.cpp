#include "base/image.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <limits>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/full_disk.h"
#include "base/random.h"
#include "base/srgb.h"
#include "base/temporary_folder.h"

namespace redmap {
namespace {

Image noise_image(int width, int height, int channels, float low, float high) {
  Image image(width, height, channels);
  Random random(17);
  for (float& value : image.data) value = low + (high - low) * random.next_float();
  return image;
}

std::string error_of_reading(const std::filesystem::path& path) {
  try {
    read_image(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

testing::AssertionResult says(const std::string& message, const std::string& part) {
  if (message.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "expected \"" << part << "\" in \"" << message << "\"";
}

TEST(Image, FloatExr_ComesBackBitForBit_WithAnyNumberOfChannels) {
  const TemporaryFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    const Image image = noise_image(13, 7, channels, -5, 1e6f);
    write_image(image, folder / "a.exr");
    const Image back = read_image(folder / "a.exr");
    EXPECT_EQ(back.width, 13);
    EXPECT_EQ(back.height, 7);
    EXPECT_EQ(back.channels, channels);
    EXPECT_EQ(back.data, image.data);
    EXPECT_TRUE(back.channel_names.empty());
  }
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(Image, HalfExr_RoundsToElevenBits_AndStaysFinite) {
  const TemporaryFolder folder;
  Image image = noise_image(16, 4, 3, 0, 100);
  image.data[5] = 1e9f;
  write_image(image, folder / "a.exr", ExrPrecision::kHalf);
  const Image back = read_image(folder / "a.exr");
  EXPECT_EQ(back.data[5], 65504);
  image.data[5] = 65504;
  for (std::size_t i = 0; i < image.data.size(); ++i) EXPECT_NEAR(back.data[i], image.data[i], image.data[i] / 2048);
}

TEST(Image, NamedChannels_ComeBackByName) {
  const TemporaryFolder folder;
  Image image = noise_image(3, 2, 2, 0, 1);
  image.channel_names = {"weight.1", "interior"};
  write_image(image, folder / "a.exr");
  const Image back = read_image(folder / "a.exr");
  // OpenEXR orders channels by name.
  EXPECT_EQ(back.channel_names, (std::vector<std::string>{"interior", "weight.1"}));
  EXPECT_EQ(back.at(2, 1, 0), image.at(2, 1, 1));
  EXPECT_EQ(back.at(2, 1, 1), image.at(2, 1, 0));
}

TEST(Image, PngByteValues_ComeBackExactly) {
  const TemporaryFolder folder;
  for (const int channels : {1, 2, 3, 4}) {
    Image image(64, 4, channels);
    for (std::size_t i = 0; i < image.pixels(); ++i)
      for (int c = 0; c < channels; ++c) {
        const bool alpha = channels % 2 == 0 && c == channels - 1;
        const float stored = static_cast<float>(i) / 255;
        image.data[i * channels + c] = alpha ? stored : srgb_to_linear(stored);
      }
    write_image(image, folder / "a.png");
    EXPECT_EQ(read_image(folder / "a.png").data, image.data) << channels << " channels";
  }
}

TEST(Image, PngOfValuesOutsideZeroToOne_IsClamped) {
  const TemporaryFolder folder;
  Image image(4, 1, 1);
  image.data = {-1, 2, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  write_image(image, folder / "a.png");
  EXPECT_EQ(read_image(folder / "a.png").data, (std::vector<float>{0, 1, 0, 1}));
}

TEST(Image, MiddleGrey_IsStoredInPngAsItsSrgbValue) {
  // 0.2140 linear is 127.5 / 255 in sRGB, 0.5 linear is 187.5.
  EXPECT_NEAR(linear_to_srgb(0.21404f), 0.5f, 1e-4f);
  EXPECT_NEAR(255 * linear_to_srgb(0.5f), 187.5f, 0.1f);
}

TEST(Image, TiledHalfExrWithOffsetWindow_IsReadLikeScanLines) {
  const TemporaryFolder folder;
  constexpr int kWidth = 37, kHeight = 21;
  std::vector<half> values(kWidth * kHeight);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = half(static_cast<float>(i));
  const Imath::Box2i window({-5, 3}, {-5 + kWidth - 1, 3 + kHeight - 1});
  Imf::Header header(window, window);
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  header.setTileDescription(Imf::TileDescription(16, 16, Imf::MIPMAP_LEVELS));
  {
    Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
    Imf::FrameBuffer frame;
    frame.insert("Y", Imf::Slice::Make(Imf::HALF, values.data(), window));
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles(0) - 1, 0, file.numYTiles(0) - 1, 0);
    // Coarser levels hold other values: reading one of them would show.
    std::fill(values.begin(), values.end(), half(-1.0f));
    for (int level = 1; level < file.numLevels(); ++level)
      file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  }
  const Image image = read_image(folder / "a.exr");
  ASSERT_EQ(image.pixels(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(image.data[i], static_cast<float>(i));
}

TEST(Image, MultiPartExr_IsReadAsItsFirstPart) {
  const TemporaryFolder folder;
  std::vector<Imf::Header> headers(2, Imf::Header(2, 1));
  for (std::size_t part = 0; part < 2; ++part) {
    headers[part].setName("part" + std::to_string(part));
    headers[part].setType(Imf::SCANLINEIMAGE);
    headers[part].channels().insert("Y", Imf::Channel(Imf::FLOAT));
  }
  {
    Imf::MultiPartOutputFile file((folder / "a.exr").c_str(), headers.data(), 2);
    for (int part = 0; part < 2; ++part) {
      std::vector<float> values{1.0f + static_cast<float>(part), 5};
      Imf::OutputPart output(file, part);
      Imf::FrameBuffer frame;
      frame.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 8));
      output.setFrameBuffer(frame);
      output.writePixels(1);
    }
  }
  EXPECT_EQ(read_image(folder / "a.exr").data, (std::vector<float>{1, 5}));
}

TEST(Image, LuminanceChromaExr_IsRefusedByName) {
  const TemporaryFolder folder;
  Image image(2, 2, 3);
  image.channel_names = {"Y", "RY", "BY"};
  write_image(image, folder / "a.exr");
  EXPECT_TRUE(says(error_of_reading(folder / "a.exr"), "chroma"));
}

TEST(Image, MissingFilesAndUnknownExtensions_SayWhichFile) {
  const TemporaryFolder folder;
  EXPECT_TRUE(says(error_of_reading(folder / "none.exr"), "none.exr: no such picture"));
  write_file(folder / "a.jpg", "x");
  EXPECT_TRUE(says(error_of_reading(folder / "a.jpg"), "a.jpg: expected"));
  EXPECT_THROW(write_image(Image(1, 1, 3), folder / "b.tga"), Error);
  EXPECT_THROW(write_image(Image(1, 1, 5), folder / "five.exr"), Error);
  EXPECT_THROW(write_image(Image(1, 1, 5), folder / "five.png"), Error);
  EXPECT_THROW(write_image(Image(), folder / "empty.exr"), Error);
  EXPECT_EQ(folder.entries(), 1u);
}

std::string grey_jpeg(int value) {
  const std::vector<unsigned char> pixels(16 * 24 * 3, static_cast<unsigned char>(value));
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  };
  stbi_write_jpg_to_func(append, &bytes, 16, 24, 3, pixels.data(), 90);
  return bytes;
}

TEST(Image, GreyOfAJpeg_IsLinearLight) {
  const TemporaryFolder folder;
  write_file(folder / "grey.jpg", grey_jpeg(188));  // half of the light
  const Image image = read_image(folder / "grey.jpg");
  EXPECT_EQ(image.width, 16);
  EXPECT_EQ(image.height, 24);
  for (float value : image.data) EXPECT_NEAR(value, 0.5f, 0.01f);
}

TEST(Image, TruncatedJpeg_IsAnErrorThatNamesTheFile) {
  const TemporaryFolder folder;
  const std::string whole = grey_jpeg(100);
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    write_file(folder / "cut.jpg", whole.substr(0, length));
    EXPECT_TRUE(says(error_of_reading(folder / "cut.jpg"), "cut.jpg")) << length << " of " << whole.size() << " bytes";
  }
}

class HostileImage : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Formats, HostileImage, testing::Values(".exr", ".png"));

TEST_P(HostileImage, EveryTruncation_IsAnErrorThatNamesTheFile) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("cut") + GetParam());
  write_image(noise_image(24, 40, 3, 0, 1), path);
  const std::string whole = read_file(path);
  // Cut anywhere up to the last 64 bytes: what is lost there in a PNG are check sums.
  for (std::size_t length = 0; length + 64 < whole.size(); length += 1 + length / 50) {
    write_file(path, whole.substr(0, length));
    EXPECT_TRUE(says(error_of_reading(path), "cut")) << length << " of " << whole.size() << " bytes";
  }
}

TEST_P(HostileImage, FlippedBytes_EndInAPictureOrAnError_NothingElse) {
  const TemporaryFolder folder;
  const auto path = folder / (std::string("flipped") + GetParam());
  write_image(noise_image(24, 40, 3, 0, 1), path);
  const std::string whole = read_file(path);
  Random random(3);
  int errors = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::string bytes = whole;
    // Headers are the most dangerous part.
    for (int flip = 0; flip < 3; ++flip)
      bytes[random.below(trial % 2 ? 400 : static_cast<std::uint32_t>(bytes.size()))] =
          static_cast<char>(random.next());
    write_file(path, bytes);
    errors += error_of_reading(path) != "no error";
  }
  EXPECT_GT(errors, 20);
}

TEST_P(HostileImage, FullDisk_IsAnError_AndNothingIsLeft) {
  const TemporaryFolder folder;
  const FullDisk disk(2000);
  EXPECT_THROW(write_image(noise_image(64, 64, 3, 0, 1), folder / (std::string("a") + GetParam())), Error);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(HostileImage, AbsurdSizes_AreRefusedBeforeAnyMemoryIsTaken) {
  const TemporaryFolder folder;
  // A PNG header of 2^24 - 1 pixels squared, which stb itself would accept to look at.
  std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\xff\xff\xff\0\xff\xff\xff\x08\x02\0\0\0\0\0\0\0", 33);
  write_file(folder / "a.png", png + std::string(100, '\0'));
  EXPECT_TRUE(says(error_of_reading(folder / "a.png"), "16777215 x 16777215"));

  // The data window of an OpenEXR file of 8 x 8 pixels stretched to 2^30 columns and 2^30 rows.
  write_image(Image(8, 8, 1), folder / "a.exr");
  std::string exr = read_file(folder / "a.exr");
  const std::size_t window = exr.find("box2i", exr.find("dataWindow")) + 10;
  exr.replace(window + 8, 8, std::string("\xff\xff\xff\x3f\xff\xff\xff\x3f", 8));
  write_file(folder / "a.exr", exr);
  EXPECT_TRUE(says(error_of_reading(folder / "a.exr"), "a.exr: "));
}

}  // namespace
}  // namespace redmap
