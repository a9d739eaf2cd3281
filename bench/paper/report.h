// What a bench has to tell: tables, curves and pictures, by figure of the paper. Pure data, from which the JSON, the
// HTML page and the text on the terminal are made.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/image.h"

namespace redmap::bench {

/// A cell of a table: nothing, a number, or words.
using Value = std::variant<std::monostate, double, std::string>;

struct Column {
  std::string key;    ///< in JSON; those that begin with "paper_" hold the paper's own figures
  std::string title;  ///< for people, its unit included
};

struct Table {
  std::string key, title;
  std::vector<Column> columns;
  std::vector<std::vector<Value>> rows;  ///< as long as `columns`
};

/// What was asked for, and whether it was reached.
struct Claim {
  std::string asked, found;
  bool reached = false;
};

/// A curve, or loose points. Both axes are logarithmic: values are above 0.
struct Series {
  struct Point {
    double x = 0, y = 0;
  };
  std::string name;
  std::vector<Point> points;
  bool joined = true;
  int colour = -1;  ///< of the page's eight; -1: its place in the plot
};
struct Plot {
  std::string key, title, x_title, y_title;
  std::vector<Series> series;
};

struct Picture {
  std::string label;
  Image image;  ///< linear light
};
/// Pictures of one size, to be compared by dragging an edge over two of them.
struct Slider {
  std::string title;
  std::vector<Picture> pictures;
  int zoom = 1;  ///< screen pixels a pixel
};
/// Frames of one size, shown again and again.
struct Loop {
  std::string label;
  std::vector<Image> frames;
  int zoom = 1;
};

struct Figure {
  std::string id;     ///< "fig5", "basis", ...
  std::string title;  ///< "Fig. 5: size of a map"
  std::string paper;  ///< what the paper shows, or asserts
  std::string ours;   ///< how it was measured here
  std::vector<Table> tables;
  std::vector<Claim> claims;
  std::vector<Plot> plots;
  std::vector<Picture> pictures;
  std::vector<Slider> sliders;
  std::vector<Loop> loops;
  std::vector<std::string> notes;
};

struct Report {
  std::vector<Figure> figures;
  bool quick = false;
  int map_size = 0;
  double seconds = 0;
};

/// Three digits that count, and all of whole numbers under a million; "0" below 5e-7; "-" for nothing.
std::string text_of(const Value& value);

}  // namespace redmap::bench
