#include <fmt/format.h>

#include <algorithm>

#include "page_texts.h"
#include "renderings.h"
#include "svg_plot.h"

namespace redmap::bench {

namespace {

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return at < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) : 0u;
    };
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int digit = 0; digit < 4; ++digit) text += kDigits[group >> (18 - 6 * digit) & 63];
  }
  for (std::size_t i = 0; i < (3 - bytes.size() % 3) % 3; ++i) text[text.size() - 1 - i] = '=';
  return text;
}

std::string data_url(const Image& image) { return "data:image/png;base64," + base64(encode_png(image)); }

bool is_paper(const Column& column) { return column.key.starts_with("paper_") && column.key != "paper_over_ours"; }

std::string html_of(const Table& table) {
  std::string html = fmt::format("<div class=\"table\"><table id=\"table-{}\"><caption>{}</caption><thead><tr>",
                                 escaped(table.key), escaped(table.title));
  for (const Column& column : table.columns)
    html += fmt::format("<th{}>{}</th>", is_paper(column) ? " class=\"paper\"" : "", escaped(column.title));
  html += "</tr></thead><tbody>";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html +=
          fmt::format("<td class=\"{}{}\">{}</td>", std::holds_alternative<std::string>(row[i]) ? "words" : "number",
                      is_paper(table.columns[i]) ? " paper" : "", escaped(text_of(row[i])));
    html += "</tr>";
  }
  return html + "</tbody></table></div>\n";
}

std::string html_of(const Claim& claim) {
  return fmt::format("<li class=\"{}\"><b>{}</b> {} <span>{}</span></li>", claim.reached ? "reached" : "missed",
                     claim.reached ? "Reached" : "Not reached", escaped(claim.asked), escaped(claim.found));
}

std::string html_of(const Slider& slider) {
  std::string options, pictures;
  for (std::size_t i = 0; i < slider.pictures.size(); ++i) {
    options += fmt::format("<option value=\"{}\">{}</option>", i, escaped(slider.pictures[i].label));
    pictures += fmt::format("<img alt=\"{}\" src=\"{}\">", escaped(slider.pictures[i].label),
                            data_url(slider.pictures[i].image));
  }
  const Image& first = slider.pictures.front().image;
  return fmt::format(
      "<figure class=\"slider\" style=\"--width:{}px\"><figcaption>{}</figcaption><div class=\"choice\"><select "
      "class=\"left\" "
      "aria-label=\"left picture\">{}</select><select class=\"right\" aria-label=\"right picture\">{}</select></div>"
      "<div class=\"stage\" tabindex=\"0\" role=\"slider\" aria-label=\"edge between the pictures\" "
      "aria-valuemin=\"0\" "
      "aria-valuemax=\"100\" aria-valuenow=\"50\" style=\"aspect-ratio:{}/{}\">{}<div "
      "class=\"edge\"></div></div></figure>\n",
      first.width * slider.zoom, escaped(slider.title), options, options, first.width, first.height, pictures);
}

/// The frames side by side, of which the page shows one after the other.
Image strip_of(const std::vector<Image>& frames) {
  const int width = frames.front().width, height = frames.front().height;
  Image strip(width * static_cast<int>(frames.size()), height, 3);
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) strip.set_rgb(static_cast<int>(i) * width + x, y, frames[i].rgb(x, y));
  return strip;
}

std::string html_of(const Loop& loop) {
  const Image& first = loop.frames.front();
  return fmt::format(
      "<figure class=\"loop\" style=\"--frames:{}\"><div style=\"width:{}px;aspect-ratio:{}/{}\"><img alt=\"\" "
      "src=\"{}\"></div><figcaption>{}</figcaption></figure>\n",
      loop.frames.size(), first.width * loop.zoom, first.width, first.height, data_url(strip_of(loop.frames)),
      escaped(loop.label));
}

template <typename Part>
std::string html_of_all(const std::vector<Part>& parts, const char* container) {
  if (parts.empty()) return {};
  std::string html = fmt::format("<div class=\"{}\">", container);
  for (const Part& part : parts) html += html_of(part);
  return html + "</div>\n";
}

std::string html_of(const Figure& figure) {
  std::string html =
      fmt::format("<section id=\"{}\"><h2>{}</h2><dl><dt>Paper</dt><dd>{}</dd><dt>Here</dt><dd>{}</dd></dl>",
                  escaped(figure.id), escaped(figure.title), escaped(figure.paper), escaped(figure.ours));
  if (!figure.claims.empty()) {
    html += "<ul class=\"claims\">";
    for (const Claim& claim : figure.claims) html += html_of(claim);
    html += "</ul>";
  }
  for (const std::string& note : figure.notes) html += "<p class=\"note\">" + escaped(note) + "</p>";
  for (const Table& table : figure.tables) html += html_of(table);
  if (!figure.plots.empty()) {
    html += "<div class=\"plots\">";
    for (const Plot& plot : figure.plots) html += svg_of(plot);
    html += "</div>";
  }
  html += html_of_all(figure.sliders, "sliders") + html_of_all(figure.loops, "loops");
  for (const Picture& picture : figure.pictures)
    html += fmt::format("<figure class=\"picture\"><img alt=\"{0}\" src=\"{1}\"><figcaption>{0}</figcaption></figure>",
                        escaped(picture.label), data_url(picture.image));
  return html + "</section>\n";
}

std::string head_of(const Report& report, const Origin& origin) {
  std::size_t claims = 0, reached = 0;
  std::string list, contents, facts;
  for (const Figure& figure : report.figures) {
    contents += fmt::format("<a href=\"#{}\">{}</a>", escaped(figure.id), escaped(figure.title));
    for (const Claim& claim : figure.claims) {
      list += html_of(
          {escaped(figure.title.substr(0, figure.title.find(':'))) + ": " + claim.asked, claim.found, claim.reached});
      ++claims, reached += claim.reached;
    }
  }
  for (const auto& [name, value] : origin)
    facts += fmt::format("<dt>{}</dt><dd>{}</dd>", escaped(name), escaped(value));
  return fmt::format(
      "<header><h1>The paper, measured anew</h1><p class=\"lead\">Van Horn and Turk, \"Antialiasing Procedural Shaders "
      "with Reduction Maps\" (TVCG 2008): its figures by its own method and by redmap, each beside what the paper "
      "says. Tinted columns are the paper's.</p><dl class=\"origin\">{}</dl></header><nav>{}</nav>"
      "<section id=\"claims\"><h2>What was asked for: {} of {} reached</h2><ul class=\"claims\">{}</ul></section>\n",
      facts, contents, reached, claims, list);
}

}  // namespace

std::string html_of(const Report& report, const Origin& origin) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"><meta name=\"color-scheme\" content=\"light dark\">"
      "<title>redmap: the paper, measured anew</title><link rel=\"icon\" href=\"data:,\"><style>";
  html.append(kPageStyle).append("</style></head><body><main>\n").append(head_of(report, origin));
  for (const Figure& figure : report.figures) html += html_of(figure);
  return html.append("</main><script>").append(kPageScript).append("</script></body></html>\n");
}

}  // namespace redmap::bench
