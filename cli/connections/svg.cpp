// The overview as a picture: a column for each controller, a box for each object, an arrow for each leading
// value.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cli/connections/overview.hpp"

namespace lockstep::cli {
namespace {

constexpr int kColumn = 260;  // [px] from controller to controller
constexpr int kRow = 64;      // from box to box
constexpr int kBoxWidth = 150;
constexpr int kBoxHeight = 40;
constexpr int kBorder = 30;
constexpr int kFirstRow = 60;  // below the names of the controllers

/// A text as it may stand in XML.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

class Drawing {
 public:
  Drawing(const System& system, const Connections& connections, const OverviewOptions& options)
      : system_(system), connections_(connections), options_(options) {
    place();
  }

  std::string text();

 private:
  struct Box {
    std::size_t controller = 0;
    int row = 0;
    const LeadingObject* object = nullptr;
    int x() const { return kBorder + static_cast<int>(controller) * kColumn; }
    int y() const { return kFirstRow + row * kRow; }
  };
  void place();
  void add(const SystemObject& object);
  std::string box_text(const Box& box) const;
  std::string arrow_text(const LeadingObject* from, const LeadingObject* to, const std::string& label,
                         const Interconnection& row) const;

  const System& system_;
  const Connections& connections_;
  const OverviewOptions& options_;
  std::map<const LeadingObject*, Box> boxes_;
  std::vector<const LeadingObject*> order_;
  std::map<std::size_t, int> rows_;  // taken, of each controller
};

void Drawing::add(const SystemObject& object) {
  if (object.object == nullptr || boxes_.contains(object.object)) return;
  boxes_[object.object] = {object.controller, rows_[object.controller]++, object.object};
  order_.push_back(object.object);
}

void Drawing::place() {
  for (const Interconnection& row : connections_.rows()) {
    if (!is_shown(system_, row, options_)) continue;
    add(row.source);
    if (!row.local()) add({row.following.controller, row.proxy});
    add(row.following);
  }
}

std::string Drawing::box_text(const Box& box) const {
  const bool proxy = box.object->kind == ObjectKind::TO_LeadingAxisProxy;
  std::string text =
      fmt::format(R"x(<rect x="{}" y="{}" width="{}" height="{}" rx="{}" fill="{}" stroke="#333"/>)x"
                  "\n",
                  box.x(), box.y(), kBoxWidth, kBoxHeight, proxy ? 18 : 4, proxy ? "#eef4fb" : "#fff");
  const DelayTime* const delay = connections_.delay_of(box.object);
  const bool shows = delay != nullptr && options_.delays;
  text += fmt::format(R"x(<text x="{}" y="{}" text-anchor="middle">{}</text>)x"
                      "\n",
                      box.x() + kBoxWidth / 2, box.y() + (shows ? 17 : 25), escaped(box.object->name));
  if (shows)
    text += fmt::format(R"x(<text x="{}" y="{}" text-anchor="middle" font-size="11" fill="#555">{}</text>)x"
                        "\n",
                        box.x() + kBoxWidth / 2, box.y() + 33,
                        (delay->proxy ? "forward by " : "delay ") + milliseconds_text(delay->configured));
  return text;
}

std::string Drawing::arrow_text(const LeadingObject* from, const LeadingObject* to, const std::string& label,
                                const Interconnection& row) const {
  const Box& a = boxes_.at(from);
  const Box& b = boxes_.at(to);
  const bool below = a.controller == b.controller;  // round the right side of the column
  const bool rightward = b.controller >= a.controller;
  const int x1 = a.x() + (rightward ? kBoxWidth : 0);
  const int x2 = b.x() + (rightward && !below ? 0 : kBoxWidth);
  const int y1 = a.y() + kBoxHeight / 2;
  const int y2 = b.y() + kBoxHeight / 2;
  const int bend = below ? 40 : (x2 - x1) / 2;
  const char* const colour = row.recursive ? "#c0392b" : row.ambiguous ? "#b9770e" : "#2c5d8f";
  std::string text = fmt::format(
      R"x(<path d="M{} {} C{} {} {} {} {} {}" fill="none" stroke="{}"{} marker-end="url(#end)"/>)x"
      "\n",
      x1, y1, x1 + bend, y1, below ? x2 + bend : x2 - bend, y2, x2, y2, colour,
      row.left_out ? R"x( stroke-dasharray="5 4")x" : "");
  if (!label.empty())
    text += fmt::format(R"x(<text x="{}" y="{}" font-size="11" fill="{}" text-anchor="middle">{}</text>)x"
                        "\n",
                        (x1 + x2) / 2 + (below ? 45 : 0), (y1 + y2) / 2 - 5, colour, escaped(label));
  return text;
}

std::string Drawing::text() {
  int highest = 1;
  for (const auto& [controller, rows] : rows_) highest = std::max(highest, rows);
  const int width = 2 * kBorder + static_cast<int>(system_.controllers.size()) * kColumn;
  const int height = kFirstRow + highest * kRow + kBorder;
  std::string text = fmt::format(
      R"x(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="sans-serif" font-size="13">
<title>{2}</title>
<defs><marker id="end" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" orient="auto"><path d="M0 0 L8 4 L0 8 z" fill="#2c5d8f"/></marker></defs>
<rect width="{0}" height="{1}" fill="#fff"/>
)x",
      width, height, escaped(system_.name));
  for (std::size_t i = 0; i < system_.controllers.size(); ++i)
    text += fmt::format(R"x(<text x="{}" y="35" font-weight="bold" text-anchor="middle">{}</text>)x"
                        "\n",
                        kBorder + static_cast<int>(i) * kColumn + kBoxWidth / 2,
                        escaped(system_.controllers[i].name));
  std::map<const LeadingAxisProxy*, std::vector<const LeadingObject*>> drawn;
  for (const Interconnection& row : connections_.rows()) {
    if (!is_shown(system_, row, options_)) continue;
    if (row.local()) {
      text += arrow_text(row.source.object, row.following.object, "", row);
      continue;
    }
    auto& sources = drawn[row.proxy];
    if (std::ranges::find(sources, row.source.object) == sources.end()) {
      sources.push_back(row.source.object);
      text += arrow_text(row.source.object, row.proxy, row.area, row);
    }
    if (row.following.object != nullptr) text += arrow_text(row.proxy, row.following.object, "", row);
  }
  for (const LeadingObject* const object : order_) text += box_text(boxes_.at(object));
  return text + "</svg>\n";
}

}  // namespace

std::string overview_svg(const System& system, const Connections& connections,
                         const OverviewOptions& options) {
  return Drawing(system, connections, options).text();
}

}  // namespace lockstep::cli
