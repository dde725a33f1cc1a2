// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "scenes/federation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "scenes/step.hpp"

namespace impinge::scenes {
namespace {

constexpr double kThrough = std::numeric_limits<double>::infinity();
constexpr int kKinds = 8;
constexpr Point kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

struct Box {
  Point low, high;
};

/// One IFC file, told in metres.
class File {
 public:
  File(const std::string& schema, const StepUnit& unit, double unit_in_metres, const std::string& system, int guids,
       bool national_grid)
      : step_(schema, unit, guids), unit_(unit_in_metres) {
    const Point at = national_grid ? Point{512'345.5, 5'412'345.25, 412.5} : Point{0, 0, 0};
    site_ = step_.placement("$", national_grid ? step_.axes(in_unit(at), kZ, {0.6, 0.8, 0}) : step_.axes(in_unit(at)));
    if (!system.empty()) system_ = step_.line("IFCSYSTEM('" + step_.guid() + "',$,'" + system + "',$,$)");
  }

  void begin_storey(int number, double height) {
    if (number > 1) step_.begin_storey("Level " + std::to_string(number), height / unit_);
  }

  /// What is extruded from `at` along `axis`, the profile's x along `x`; `more` is what the class has behind its Tag.
  std::string extruded(const std::string& kind, const std::string& name, const std::string& profile, const Point& at,
                       const Point& axis, const Point& x, double length, const std::string& more = "") {
    const std::string place = step_.placement(site_, step_.axes(in_unit(at), axis, x));
    const std::string shape = step_.shape(step_.shown(step_.extruded(profile, length / unit_)));
    const std::string part = step_.product(name, place, shape, kind, ",'" + step_.guid() + "'" + more);
    if (kind == "IFCOPENINGELEMENT") return part;
    const std::string fire = step_.line("IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F90'),$)");
    const std::string outside = step_.line("IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.F.),$)");
    const std::string set =
        step_.line("IFCPROPERTYSET('" + step_.guid() + "',$,'Pset_Building',$,(" + fire + "," + outside + "))");
    step_.line("IFCRELDEFINESBYPROPERTIES('" + step_.guid() + "',$,$,$,(" + part + ")," + set + ")");
    if (!system_.empty())
      step_.line("IFCRELASSIGNSTOGROUP('" + step_.guid() + "',$,$,$,(" + part + "),$," + system_ + ")");
    return part;
  }
  std::string box(const std::string& kind, const std::string& name, const Box& box, const std::string& more = "") {
    const auto& [low, high] = box;
    return extruded(kind, name, step_.rectangle((high.x - low.x) / unit_, (high.y - low.y) / unit_),
                    {(low.x + high.x) / 2, (low.y + high.y) / 2, low.z}, kZ, kX, high.z - low.z, more);
  }
  void cut(const std::string& part, const std::string& opening) {
    step_.line("IFCRELVOIDSELEMENT('" + step_.guid() + "',$,$,$," + part + "," + opening + ")");
  }
  void fill(const std::string& opening, const std::string& part) {
    step_.line("IFCRELFILLSELEMENT('" + step_.guid() + "',$,$,$," + opening + "," + part + ")");
  }
  /// A profile of the standard with these lengths, about the middle of its box.
  std::string profile(const std::string& kind, std::initializer_list<double> lengths, const std::string& more = "") {
    std::string text = "IFC" + kind + "PROFILEDEF(.AREA.,$," + step_.flat_axes();
    for (const double length : lengths) text += "," + step_number(length / unit_);
    return step_.line(text + more + ")");
  }
  [[nodiscard]] std::string text() const { return step_.text(); }

 private:
  [[nodiscard]] Point in_unit(const Point& p) const { return {p.x / unit_, p.y / unit_, p.z / unit_}; }

  Step step_;
  double unit_;
  std::string site_, system_;
};

/// One room, whose corner is at `corner`.
class Room {
 public:
  Room(Federation& to, std::array<File*, 4> files, std::string number, const Point& corner)
      : to_(to),
        architecture_(*files[0]),
        structure_(*files[1]),
        ventilation_(*files[2]),
        electrical_(*files[3]),
        number_(std::move(number)),
        corner_(corner) {}

  void build(int kind) {
    build_structure();
    build_architecture();
    build_ventilation();
    build_electrical();
    plant(kind);
  }

 private:
  std::string name(const std::string& what) {
    ++to_.parts;
    return what + " " + number_;
  }
  [[nodiscard]] Point at(double x, double y, double z) const { return {corner_.x + x, corner_.y + y, corner_.z + z}; }
  [[nodiscard]] Box box(const Point& low, const Point& high) const {
    return {at(low.x, low.y, low.z), at(high.x, high.y, high.z)};
  }
  void pair(const std::string& a, const std::string& b, Verdict verdict, double depth, double fails_below) {
    const auto [first, second] = std::minmax({a + " " + number_, b + " " + number_});
    to_.pairs.push_back({first, second, verdict, depth, fails_below});
  }
  void touch(const std::string& a, std::initializer_list<std::string> others) {
    for (const std::string& b : others) pair(a, b, Verdict::touching, 0, 0);
  }

  void build_structure() {
    structure_.box("IFCSLAB", name("Slab, 250 mm"), box({-0.25, -0.25, -0.25}, {7.25, 5.5, 0}), ",.FLOOR.");
    for (const double y : {1., 4.}) {
      const std::string column = y < 2 ? "Column A" : "Column B";
      structure_.box("IFCCOLUMN", name(column), box({6.5, y, 0}, {6.8, y + 0.3, 3.2}));
      touch(column, {"Slab, 250 mm", "Tr\u00e4ger"});
    }
    structure_.extruded("IFCBEAM", name("Tr\\X2\\00E4\\X0\\ger"),
                        structure_.profile("ISHAPE", {0.2, 0.3, 0.01, 0.015}, ",$"), at(6.65, 0.8, 3.35), kY, kX, 3.7);
  }

  std::string opening(const std::string& wall, const Box& hole) {
    const std::string made = architecture_.box("IFCOPENINGELEMENT", "Opening", hole, ",.OPENING.");
    architecture_.cut(wall, made);
    return made;
  }
  void build_architecture() {
    const std::string standard = ",.STANDARD.";
    const std::string north =
        architecture_.box("IFCWALL", name("Basic Wall: north"), box({0, 5, 0}, {7, 5.2, 3}), standard);
    architecture_.fill(
        opening(north, box({1, 4.9, 0}, {2, 5.3, 2.1})),
        architecture_.box("IFCDOOR", name("Door 1000 x 2100"), box({1, 5, 0}, {2, 5.2, 2.1}), ",$,$,$,$,$"));
    architecture_.cut(north,
                      architecture_.extruded("IFCOPENINGELEMENT", "Opening", architecture_.profile("CIRCLE", {0.15}),
                                             at(3.5, 4.9, 2.5), kY, kX, 0.4, ",.OPENING."));
    const std::string south =
        architecture_.box("IFCWALL", name("Basic Wall: south"), box({0, 0, 0}, {7, 0.2, 3}), standard);
    architecture_.fill(opening(south, box({4, -0.1, 1}, {5.5, 0.3, 2})),
                       architecture_.box("IFCWINDOW", name("Window"), box({4, 0, 1}, {5.5, 0.2, 2}), ",$,$,$,$,$"));
    architecture_.box("IFCWALL", name("Basic Wall: west"), box({0, 0.2, 0}, {0.2, 5, 3}), standard);
    for (const double x : {1., 2.5}) {
      const std::string table = x < 2 ? "Table A" : "Table B";
      architecture_.box("IFCFURNISHINGELEMENT", name(table), box({x, 3, 0}, {x + 1, 3.6, 0.75}));
      touch("Slab, 250 mm", {table});
    }
    touch("Slab, 250 mm", {"Basic Wall: north", "Basic Wall: south", "Basic Wall: west", "Door 1000 x 2100"});
    touch("Basic Wall: north", {"Door 1000 x 2100", "Basic Wall: west"});
    touch("Basic Wall: south", {"Window", "Basic Wall: west"});
  }

  void build_ventilation() {
    File& file = ventilation_;
    const std::string duct = file.profile("RECTANGLEHOLLOW", {0.4, 0.3, 0.01}, ",$,$");
    file.extruded("IFCFLOWSEGMENT", name("Duct 400 x 300"), duct, at(5.5, 0.5, 2.55), kY, kX, 4);
    file.extruded("IFCFLOWFITTING", name("Duct end"), duct, at(5.5, 4.5, 2.55), kY, kX, 0.3);
    touch("Duct 400 x 300", {"Duct end"});
    file.extruded("IFCFLOWSEGMENT", name("Duct DN200"), file.profile("CIRCLEHOLLOW", {0.1, 0.005}), at(4.5, 0.5, 2.5),
                  kY, kX, 4);
    file.extruded("IFCFLOWSEGMENT", name("Pipe DN100"), file.profile("CIRCLEHOLLOW", {0.05, 0.005}), at(3.5, 4.5, 2.5),
                  kY, kX, 1.2);
    file.extruded("IFCBUILDINGELEMENTPROXY", name("Sleeve"), file.profile("CIRCLEHOLLOW", {0.12, 0.04}),
                  at(3.5, 4.95, 2.5), kY, kX, 0.3, ",$");
  }

  void build_electrical() {
    File& file = electrical_;
    file.extruded("IFCCABLECARRIERSEGMENT", name("Conduit"), file.profile("CIRCLE", {0.02}), at(1, 2.5, 2.9), kX, kY, 4,
                  ",.CONDUITSEGMENT.");
    file.extruded("IFCCABLECARRIERSEGMENT", name("Cable tray"),
                  file.profile("USHAPE", {0.1, 0.05, 0.002, 0.002}, ",$,$,$"), at(2, 0.5, 2.7), kY, kX, 4,
                  ",.CABLETRAYSEGMENT.");
    file.box("IFCLIGHTFIXTURE", name("Lamp"), box({3, 2, 2}, {3.5, 2.25, 2.125}), ",$");
    file.box("IFCOUTLET", name("Socket"), box({2, 0.2, 0.3}, {2.1, 0.25, 0.4}), ",.POWEROUTLET.");
    touch("Socket", {"Basic Wall: south"});
  }

  void plant(int kind) {
    // The largest disc between a square corner's outer sides and its inner corner, of walls of thickness 1.
    const double corner = std::sqrt(2) / (1 + std::sqrt(2));
    File& file = kind == 4                ? structure_
                 : kind == 5              ? architecture_
                 : kind == 3 || kind == 6 ? electrical_
                                          : ventilation_;
    switch (kind) {
      case 1:
        file.extruded("IFCFLOWSEGMENT", name("Duct 200 x 200"),
                      file.profile("RECTANGLEHOLLOW", {0.2, 0.2, 0.01}, ",$,$"), at(6, 2.5, 3.35), kX, kY, 1.2);
        pair("Duct 200 x 200", "Tr\u00e4ger", Verdict::penetrating, 0.01 * corner, kThrough);
        break;
      case 2:
        file.extruded("IFCFLOWSEGMENT", name("Pipe DN80"), file.profile("CIRCLEHOLLOW", {0.04, 0.004}), at(3, 4.6, 1),
                      kY, kX, 1);
        pair("Pipe DN80", "Basic Wall: north", Verdict::penetrating, 0.1, kThrough);
        break;
      case 3:
        file.extruded("IFCCABLECARRIERSEGMENT", name("Hidden conduit"), file.profile("CIRCLE", {0.0125}),
                      at(1, 0.1, 0.6), kX, kY, 2, ",.CONDUITSEGMENT.");
        pair("Hidden conduit", "Basic Wall: south", Verdict::inside, 0.1, kThrough);
        break;
      case 4:
        opening(architecture_.box("IFCWALL", name("Core wall"), box({3, 1, 0}, {5, 1.5, 2}), ",.STANDARD."),
                box({3.5, 0.9, 0.2}, {4, 1.6, 0.8}));
        file.box("IFCSLAB", name("Landing"), box({3.2, 1.3, 1.4}, {4.8, 2, 1.5}), ",.LANDING.");
        touch("Core wall", {"Slab, 250 mm"});
        pair("Landing", "Core wall", Verdict::penetrating, 0.2, kThrough);
        break;
      case 5:
        file.box("IFCCOLUMN", name("Column of architecture"), box({6.5, 1, 0}, {6.8, 1.3, 3.2}), ",.COLUMN.");
        touch("Column of architecture", {"Slab, 250 mm", "Tr\u00e4ger"});
        pair("Column of architecture", "Column A", Verdict::duplicate, 0.15, kThrough);
        break;
      case 6:
        file.box("IFCELECTRICAPPLIANCE", name("Cabinet"), box({0.5, 1, -0.03}, {1, 1.5, 1}), ",$");
        pair("Cabinet", "Slab, 250 mm", Verdict::penetrating, 0.03, 0.03);
        break;
      case 7:
        file.box("IFCFLOWMOVINGDEVICE", name("Pump"), box({3, 0.196, 0.5}, {3.4, 0.6, 0.9}));
        pair("Pump", "Basic Wall: south", Verdict::penetrating, 0.004, 0.004);
        break;
      default:
        break;
    }
  }

  Federation& to_;
  File &architecture_, &structure_, &ventilation_, &electrical_;
  std::string number_;
  Point corner_;
};

}  // namespace

Federation federation(const FederationOptions& options) {
  struct Trade {
    std::string name, schema;
    StepUnit unit;
    double unit_in_metres;
    std::string system;
  };
  const std::array<Trade, 4> trades{Trade{"architecture", "IFC4", kMillimetre, 0.001, ""},
                                    {"structure", "IFC2X3", kMetre, 1, ""},
                                    {"ventilation", "IFC2X3", kFoot, 0.3048, "Supply air"},
                                    {"electrical", "IFC4", kMillimetre, 0.001, "Power 1"}};
  constexpr int kGuids = 10'000'000;  // more than one file needs
  std::array<std::vector<File>, 4> files;
  int guids = 0;
  for (std::size_t t = 0; t < trades.size(); ++t)
    for (int i = 0; i < options.files[t]; ++i)
      files[t].emplace_back(trades[t].schema, trades[t].unit, trades[t].unit_in_metres, trades[t].system,
                            kGuids * guids++, options.national_grid);
  Federation made;
  const int side = static_cast<int>(std::ceil(std::sqrt(options.rooms)));
  int count = 0;
  for (int storey = 0; storey < options.storeys; ++storey) {
    const double height = 4. * storey;
    for (auto& trade : files)
      for (File& file : trade) file.begin_storey(storey + 1, height);
    for (int room = 0; room < options.rooms; ++room, ++count) {
      std::array<File*, 4> its{};
      for (std::size_t t = 0; t < files.size(); ++t) its[t] = &files[t][count % files[t].size()];
      Room(made, its, std::to_string(storey + 1) + "." + std::to_string(room + 1),
           {8. * (room % side), 6.25 * (room / side), height})
          .build(count % kKinds);
    }
  }
  for (std::size_t t = 0; t < trades.size(); ++t)
    for (std::size_t i = 0; i < files[t].size(); ++i)
      made.files.push_back({trades[t].name + " " + std::to_string(i + 1) + ".ifc", files[t][i].text()});
  std::ranges::sort(made.pairs, {}, [](const FederationPair& pair) { return std::tie(pair.a, pair.b); });
  return made;
}

}  // namespace impinge::scenes
