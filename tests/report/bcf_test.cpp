// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge clash --bcf`, read back and held against the published schemas.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "bcf_reader.hpp"
#include "models.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

double dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Whether a point in the BCF's coordinates is in the picture.
void expect_seen(const Topic& topic, const Vec& p) {
  const pugi::xml_node camera = topic.view().child("PerspectiveCamera");
  const Vec eye = vec(camera.child("CameraViewPoint")), forward = vec(camera.child("CameraDirection"));
  const Vec up = vec(camera.child("CameraUpVector"));
  EXPECT_NEAR(dot(forward, forward), 1, 1e-9);
  EXPECT_NEAR(dot(up, up), 1, 1e-9);
  EXPECT_NEAR(dot(forward, up), 0, 1e-9);
  EXPECT_GT(up.z, 0) << "Z is up in BCF";
  const double angle = camera.child("FieldOfView").text().as_double();
  EXPECT_GE(angle, 45);
  EXPECT_LE(angle, 60);
  const Vec way{p.x - eye.x, p.y - eye.y, p.z - eye.z};
  const double cosine = dot(way, forward) / std::sqrt(dot(way, way));
  EXPECT_GT(cosine, std::cos(angle / 2 * std::numbers::pi / 180)) << topic.text("Title");
}

/// How many pixels are nearest to blue, orange and red.
std::array<std::size_t, 3> colours(const Pixels& pixels) {
  std::array<std::size_t, 3> count{};
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3) {
    const int r = pixels.rgb[i], g = pixels.rgb[i + 1], b = pixels.rgb[i + 2];
    count[0] += b > r + 30 ? 1 : 0;
    count[1] += r > b + 30 && g > b + 15 ? 1 : 0;
    count[2] += r > g + 60 && b > g ? 1 : 0;
  }
  return count;
}

/// How many pixels are not of the background, which is that of a corner.
std::size_t drawn(const Pixels& pixels) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3)
    count += std::equal(pixels.rgb.begin(), pixels.rgb.begin() + 3, pixels.rgb.begin() + static_cast<std::ptrdiff_t>(i))
                 ? 0
                 : 1;
  return count;
}

/// One pair of each verdict, far from the others.
class Bcf : public testing::Test {
 protected:
  void SetUp() override {
    write("a", box({0, 0, 0}, {2, 2, 2})), write("b", box({1, 1, 1}, {3, 3, 3}));
    write("c", box({3, 1, 1}, {5, 3, 3}));  // touches b
    write("big", box({20, 0, 0}, {26, 6, 6})), write("small", box({22, 2, 2}, {24, 4, 4}));
    write("d", box({40, 0, 0}, {42, 2, 2})), write("d2", box({40, 0, 0}, {42, 2, 2}));
    write("e", box({60, 0, 0}, {62, 2, 2})), write("sheet", sheet({59, -1}, {63, 3}, 1));
    write("f", box({80, 0, 0}, {82, 2, 2})), write("g", box({85, 4, 0}, {87, 6, 2}));  // 3.6 apart
  }
  void write(const std::string& name, const Solid& solid) {
    folder.write(name + ".off", off(solid));
    files.push_back(name + ".off");
  }
  [[nodiscard]] Ended clash(const std::vector<std::string>& more, const Launch& launch = {}) const {
    return impinge(folder, joined(joined({"clash", "--bcf", "out.bcf", "--quiet"}, files), more), launch);
  }
  [[nodiscard]] std::vector<Topic> topics() const { return read_bcf(folder.read("out.bcf")); }
  Folder folder;
  std::vector<std::string> files;
};

TEST_F(Bcf, HasATopicForEachPairThatFails) {
  EXPECT_EQ(clash({"--json", "out.json", "--depth", "none"}).code, 1);
  const json answer = json::parse(folder.read("out.json"));
  std::set<std::string> failing, found;
  for (const json& pair : answer.at("pairs"))
    if (pair.at("fails")) failing.insert(pair.at("id").get<std::string>());
  std::vector<std::string> titles;
  for (const Topic& topic : topics()) {
    found.insert(topic.guid);
    titles.emplace_back(topic.text("Title"));
    EXPECT_EQ(std::string(topic.topic().attribute("TopicType").value()), "Clash");
    EXPECT_EQ(topic.text("Priority"), "High");
  }
  EXPECT_EQ(found, failing);
  EXPECT_EQ(titles, (std::vector<std::string>{"d x d2, duplicate", "small inside big", "a x b, penetrating",
                                              "e x sheet, crossing"}));
}

TEST_F(Bcf, CameraSeesTheClashAndThePictureShowsIt) {
  EXPECT_EQ(clash({"--fail-on", "contact,clearance", "--clearance", "3.7"}).code, 1);
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 7U);  // a and c are 1 apart
  const std::map<std::string, Vec> places{{"d x d2", {41, 1, 1}}, {"small", {23, 3, 3}}, {"a x b", {1.5, 1.5, 1.5}},
                                          {"e x", {61, 1, 1}},    {"b x", {3, 2, 2}},    {"a x c", {2.5, 1.5, 1.5}},
                                          {"f x", {83.5, 3, 1}}};
  for (const Topic& topic : all) {
    const std::string title = topic.text("Title");
    const auto place =
        std::find_if(places.begin(), places.end(), [&](const auto& p) { return title.starts_with(p.first); });
    ASSERT_NE(place, places.end()) << title;
    expect_seen(topic, place->second);
    EXPECT_EQ(topic.snapshot.width, 640U);
    EXPECT_EQ(topic.snapshot.height, 480U);
    const auto [blue, orange, red] = colours(topic.snapshot);
    EXPECT_GT(drawn(topic.snapshot), 10'000U) << title;
    if (title.starts_with("d x")) continue;  // both colours in one, and no line of contact that ends
    EXPECT_GT(blue, 1000U) << title;
    EXPECT_GT(orange, 1000U) << title;
    EXPECT_GT(red, 50U) << title;
  }
}

TEST_F(Bcf, SelectsBothPartsByFileAndName) {
  EXPECT_EQ(impinge(folder, {"clash", "--bcf", "out.bcf", "--quiet", "a.off", "b.off"}).code, 1);
  const Topic topic = std::move(topics().at(0));
  EXPECT_TRUE(topic.text("Title").starts_with("a x b, 1"));
  const auto names = [&](const pugi::xml_node& list) {
    std::vector<std::string> found;
    for (const pugi::xml_node& component : list.children("Component"))
      found.push_back(std::string(component.child("OriginatingSystem").text().get()) + ":" +
                      component.child("AuthoringToolId").text().get());
    return found;
  };
  const pugi::xml_node components = topic.view().child("Components");
  EXPECT_EQ(names(components.child("Selection")), (std::vector<std::string>{"a.off:a", "b.off:b"}));
  // No viewer is asked to hide all but what it may not find.
  EXPECT_TRUE(components.child("Visibility").attribute("DefaultVisibility").as_bool());
  EXPECT_FALSE(components.child("Visibility").child("Exceptions"));
  std::set<std::string> colours_used;
  for (const pugi::xml_node& colour : components.child("Coloring")) {
    EXPECT_EQ(names(colour).size(), 1U);
    colours_used.insert(colour.attribute("Color").value());
  }
  EXPECT_EQ(colours_used.size(), 2U);
  const std::string figures = topic.text("Description");
  for (const char* word : {"penetrating", "a (a.off)", "b (b.off)", "Depth", "Region 1"})
    EXPECT_NE(figures.find(word), std::string::npos) << figures;
  EXPECT_EQ(figures.find("surface"), std::string::npos) << figures;
}

TEST_F(Bcf, UnitsAndAxesAreTheStandards) {
  const auto eye = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(clash(joined(more, {"--depth", "none"})).code, 1);
    const std::vector<Topic> all = topics();
    return std::pair{vec(all[2].view().child("PerspectiveCamera").child("CameraViewPoint")),
                     vec(all[2].view().child("Lines").child("Line").child("StartPoint"))};
  };
  const auto [m, line] = eye({});
  const auto [mm, line_mm] = eye({"--unit", "mm"});
  EXPECT_DOUBLE_EQ(mm.x, 0.001 * m.x);
  EXPECT_DOUBLE_EQ(mm.z, 0.001 * m.z);
  EXPECT_DOUBLE_EQ(line_mm.y, 0.001 * line.y);
  const auto [in, line_in] = eye({"--unit", "in", "--up", "z"});
  EXPECT_DOUBLE_EQ(in.y, 0.0254 * m.y);
  // With Y up in the files, what is (x, y, z) there is (x, -z, y) in BCF.
  eye({"--up", "y"});
  const std::vector<Topic> turned = topics();
  expect_seen(turned[2], {1.5, -1.5, 1.5});
  expect_seen(turned[1], {23, -3, 3});
}

TEST_F(Bcf, TitlesHaveLengthsInMillimetres) {
  const auto title = [&](const std::vector<std::string>& more) {
    EXPECT_EQ(impinge(folder, joined({"clash", "--bcf", "out.bcf", "--quiet"}, more)).code, 1);
    return topics().at(0).text("Title");
  };
  const std::vector<std::string> near{"f.off", "g.off", "--clearance", "4", "--fail-on", "clearance"};
  // From (82, 2) to (85, 4).
  EXPECT_EQ(title(joined(near, {"--unit", "m"})), "f x g, 3606 mm apart");
  EXPECT_EQ(title(joined(near, {"--unit", "mm"})), "f x g, 3.6 mm apart");
  EXPECT_EQ(title(joined(near, {"--unit", "in"})), "f x g, 92 mm apart");
  EXPECT_EQ(title(near), "f x g, 3.61 (unit unknown) apart");
}

TEST_F(Bcf, Of3Point0HasItsLists) {
  folder.write("d.json", R"({"a | b":{"status":"Approved","comment":"as agreed"}})");
  EXPECT_EQ(clash({"--bcf-version", "3.0", "--author", "Ann <ann@x.org>", "--decisions", "d.json"}).code, 1);
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 4U);
  std::set<std::string> labels, statuses;
  for (const Topic& topic : all) {
    statuses.insert(topic.topic().attribute("TopicStatus").value());
    for (std::string& label : texts(topic.topic().child("Labels"), "Label")) labels.insert(std::move(label));
    EXPECT_EQ(topic.text("CreationAuthor"), "Ann <ann@x.org>");
    EXPECT_EQ(topic.view().child("PerspectiveCamera").child("AspectRatio").text().as_double(), 640.0 / 480);
  }
  EXPECT_EQ(labels, (std::set<std::string>{"duplicate", "inside", "penetrating", "crossing"}));
  EXPECT_EQ(statuses, (std::set<std::string>{"Approved", "Open"}));
  const auto of_sheet = std::ranges::count_if(all, [](const Topic& topic) {
    return topic.text("Description").find("is a surface, which has no inside") != std::string_view::npos;
  });
  EXPECT_EQ(of_sheet, 1);
  const pugi::xml_node comment = all[2].topic().child("Comments").child("Comment");
  EXPECT_EQ(std::string(comment.child("Comment").text().get()), "as agreed");
  EXPECT_EQ(std::string(comment.child("Author").text().get()), "Ann <ann@x.org>");
  pugi::xml_document extensions;
  for (const Member& member : unzip(folder.read("out.bcf")))
    if (member.name == "extensions.xml") extensions.load_string(member.bytes.c_str());
  const auto words = [&](const char* list) {
    std::set<std::string> found;
    for (const pugi::xml_node& word : extensions.document_element().child(list)) found.insert(word.text().get());
    return found;
  };
  EXPECT_EQ(words("TopicLabels"), labels);
  EXPECT_EQ(words("TopicStatuses"), statuses);
  EXPECT_EQ(words("Users"), std::set<std::string>{"Ann <ann@x.org>"});
  EXPECT_EQ(words("Stages"), std::set<std::string>{});
  folder.write("d.json", R"({"a | b":{"status":"Approved","comment":"as agreed","due":"2024-06-01"}})");
  for (const char* version : {"2.1", "3.0"}) {
    EXPECT_EQ(
        clash({"--bcf-version", version, "--due", "2024-06-14", "--stage", "LPH 5", "--decisions", "d.json"}).code, 1);
    for (const Topic& topic : topics()) {
      const bool is_decided = topic.text("Title").starts_with("a x b");
      EXPECT_EQ(topic.text("DueDate"), is_decided ? "2024-06-01T00:00:00Z" : "2024-06-14T00:00:00Z");
      EXPECT_EQ(topic.text("Stage"), "LPH 5");
    }
  }
}

/// What another tool makes of a BCF: the topic of this title has a status and two comments, and its GUID is in
/// capitals.
std::vector<Member> edited(std::vector<Member> members, const std::string& title) {
  for (Member& member : members) {
    pugi::xml_document document;
    if (!member.name.ends_with("/markup.bcf") || !document.load_string(member.bytes.c_str())) continue;
    pugi::xml_node topic = document.document_element().child("Topic");
    if (!std::string_view(topic.child("Title").text().get()).starts_with(title)) continue;
    std::string guid = topic.attribute("Guid").value();
    std::ranges::transform(guid, guid.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    topic.attribute("Guid") = guid.c_str();
    topic.attribute("TopicStatus") = "In review";
    topic.append_child("AssignedTo").text() = "Ann";
    topic.append_child("DueDate").text() = "2024-06-14T12:00:00+02:00";
    const bool is_3 = topic.child("Viewpoints");
    pugi::xml_node comments = is_3 ? topic.append_child("Comments") : document.document_element();
    for (const char* text : {" moved\nto axis B ", "", "agreed & done"})
      comments.append_child("Comment").append_child("Comment").text() = text;
    std::ostringstream bytes;
    document.save(bytes);
    member.bytes = bytes.str();
  }
  return members;
}

TEST_F(Bcf, DecisionsComeBackFromOtherTools) {
  for (const char* version : {"2.1", "3.0"}) {
    EXPECT_EQ(clash({"--bcf-version", version, "--force"}).code, 1);
    zip(folder.path() / "back.bcfzip", edited(unzip(folder.read("out.bcf")), "a x b"));
    EXPECT_EQ(clash({"--decisions", "back.bcfzip", "--json", "out.json", "--force"}).code, 1);
    for (const json& pair : json::parse(folder.read("out.json")).at("pairs")) {
      const bool is_edited = pair.at("verdict") == "penetrating";
      EXPECT_EQ(pair.at("status"), is_edited ? json("In review") : json()) << version;
      EXPECT_EQ(pair.at("comment"), is_edited ? json("moved\nto axis B\nagreed & done") : json()) << version;
      EXPECT_EQ(pair.at("assignee"), is_edited ? json("Ann") : json()) << version;
      EXPECT_EQ(pair.at("due"), is_edited ? json("2024-06-14") : json()) << version;
    }
  }
}

TEST_F(Bcf, ADayAloneIsADecisionButNoLoss) {
  folder.write("day.json", R"({"a | b":{"due":"2024-06-01"}})");
  for (const char* version : {"2.1", "3.0"}) {
    EXPECT_EQ(clash({"--bcf-version", version, "--decisions", "day.json", "--force"}).code, 1);
    const auto with_last = [&](const std::string& due, const std::string& json_name) {
      folder.write("last.bcf", folder.read("out.bcf"));
      return clash({"--decisions", "last.bcf", "--due", due, "--json", json_name, "--bcf-version", version}).code;
    };
    EXPECT_EQ(with_last("2024-06-14", "out.json"), 1);
    EXPECT_EQ(with_last("2024-06-15", "next.json"), 1);
    for (const std::vector<std::string>& day :
         {std::vector<std::string>{"--due", "2024-06-16"}, {}, {"--due", "2024-06-17"}})
      EXPECT_EQ(clash(day).code, 1) << "nobody decided anything";
    for (const json& pair : json::parse(folder.read("out.json")).at("pairs")) {
      EXPECT_EQ(pair.at("due"), pair.at("verdict") == "penetrating" ? json("2024-06-01") : json()) << version;
      EXPECT_TRUE(pair.at("status").is_null());
    }
    // What `--due` set once stays.
    for (const json& pair : json::parse(folder.read("next.json")).at("pairs"))
      EXPECT_EQ(pair.at("due"), pair.at("verdict") == "penetrating" ? json("2024-06-01")
                                : pair.at("fails")                  ? json("2024-06-14")
                                                                    : json())
          << version;
  }
}

TEST_F(Bcf, IsNotReplacedWhereDecisionsWouldBeLost) {
  EXPECT_EQ(clash({}).code, 1);
  EXPECT_EQ(clash({}).code, 1) << "nobody decided anything";
  const std::vector<Member> mine = unzip(folder.read("out.bcf"));
  zip(folder.path() / "out.bcf", edited(mine, "a x b"));
  const std::string theirs = folder.read("out.bcf");
  const Ended lost = clash({});
  EXPECT_EQ(lost.code, 2);
  EXPECT_TRUE(lost.err.starts_with("impinge: out.bcf holds 1 decision that would be lost, the first about the pair "))
      << lost.err;
  EXPECT_EQ(folder.read("out.bcf"), theirs);
  folder.write("kept.bcf", theirs);
  EXPECT_EQ(clash({"--decisions", "kept.bcf"}).code, 1);
  EXPECT_EQ(clash({"--decisions", "kept.bcf", "--bcf-version", "3.0"}).code, 1) << "it says the same";
  EXPECT_EQ(clash({}).code, 2);
  // The same in all but the day, which somebody set: unless it is that of the run.
  folder.write("no_day.json",
               R"({"a | b":{"status":"In review","comment":"moved\nto axis B\nagreed & done","assignee":"Ann"}})");
  EXPECT_EQ(clash({"--decisions", "no_day.json"}).code, 2);
  EXPECT_EQ(clash({"--decisions", "no_day.json", "--due", "2024-06-15"}).code, 2);
  EXPECT_EQ(clash({"--decisions", "no_day.json", "--due", "2024-06-14"}).code, 1);
  EXPECT_EQ(clash({"--force"}).code, 1);
  folder.write("out.bcf", "no archive");
  EXPECT_EQ(clash({}).code, 1);
}

TEST_F(Bcf, ThatIsNoneIsAnErrorWhateverItIs) {
  const auto error = [&](const std::string& bytes) {
    folder.write("bad.bcf", bytes);
    const Ended run = impinge(folder, {"clash", "a.off", "b.off", "--decisions", "bad.bcf", "--quiet"});
    EXPECT_EQ(run.code, 2) << bytes.substr(0, 100);
    EXPECT_TRUE(run.err.starts_with("impinge: bad.bcf: ")) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  const auto of = [&](const std::string& name, const std::string& bytes, const std::string& version = "bcf.version") {
    zip(folder.path() / "made.bcf", {{version, "<Version/>", ""}, {name, bytes, ""}});
    return error(folder.read("made.bcf"));
  };
  const std::string id = "01234567-89ab-5cde-8f01-23456789abcd";
  const std::string markup = "<Markup><Topic Guid=\"" + id + "\" TopicStatus=\"x\"/></Markup>";
  EXPECT_NE(error("").find("this is no BCF, a zip archive"), std::string::npos);
  EXPECT_NE(error("<Markup/>").find("this is no BCF, a zip archive"), std::string::npos);
  EXPECT_NE(of("t/markup.bcf", markup, "version.txt").find("'bcf.version' is not in it"), std::string::npos);
  EXPECT_NE(of("t/markup.bcf", "<Markup>").find("'t/markup.bcf' in it is no XML: "), std::string::npos);
  EXPECT_NE(of("t/markup.bcf", "<Markup/>").find("has no topic with a GUID"), std::string::npos);
  EXPECT_NE(of("t/markup.bcf", std::string(4'000'001, ' ')).find("more than 4,000,000 bytes"), std::string::npos);
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_NE(of("t/markup.bcf", deep).find("is no XML"), std::string::npos);
  zip(folder.path() / "made.bcf",
      {{"bcf.version", "<Version/>", ""},
       {"1/markup.bcf", markup, ""},
       {"2/markup.bcf", "<Markup><Topic Guid=\"" + id + "\" TopicStatus=\"y\"/></Markup>", ""}});
  EXPECT_NE(error(folder.read("made.bcf")).find("another topic decides otherwise about the pair " + id),
            std::string::npos);
  EXPECT_EQ(clash({}).code, 1);
  const std::string whole = folder.read("out.bcf");
  for (std::size_t i = 1; i < 20; ++i) error(whole.substr(0, whole.size() * i / 20));
  // Bytes that are something else: an answer or a sentence.
  for (std::size_t i = 0; i < 60; ++i) {
    std::string bytes = whole;
    bytes[bytes.size() - 1 - i * bytes.size() / 600] ^= 0x55;
    folder.write("bad.bcf", bytes);
    EXPECT_LE(impinge(folder, {"clash", "a.off", "b.off", "--decisions", "bad.bcf", "--quiet"}).code, 2) << i;
  }
}

TEST_F(Bcf, DateIsAskedForOrNow) {
  const auto date = [&](const std::vector<std::string>& more, const Launch& launch = {}) {
    EXPECT_EQ(clash(more, launch).code, 1);
    return topics().front().text("CreationDate");
  };
  EXPECT_EQ(date({"--date", "2024-05-31"}), "2024-05-31T00:00:00Z");
  Launch launch;
  launch.environment["SOURCE_DATE_EPOCH"] = "1000000000";
  EXPECT_EQ(date({}, launch), "2001-09-09T01:46:40Z");
  EXPECT_EQ(date({"--date", "2024-05-31T01:02:03Z"}, launch), "2024-05-31T01:02:03Z");
  EXPECT_GT(date({"--date", "now"}), "2024");
  EXPECT_GT(date({}), "2024");
  launch.environment["SOURCE_DATE_EPOCH"] = "soon";
  const Ended wrong = clash({}, launch);
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("SOURCE_DATE_EPOCH"), std::string::npos) << wrong.err;
}

TEST_F(Bcf, LimitKeepsTheWorstAndSaysSo) {
  const Ended run =
      impinge(folder, joined({"clash", "--bcf", "out.bcf", "--bcf-topics", "2", "--depth", "none"}, files));
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.err, "impinge: the BCF has the 2 worst of 4 pairs that fail, by --bcf-topics\n");
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(all[0].text("Title").starts_with("d x d2"));
  EXPECT_EQ(clash({"--bcf-topics", "0"}).code, 1);
  EXPECT_TRUE(topics().empty());
}

TEST_F(Bcf, NothingFailingIsAnArchiveWithoutTopics) {
  EXPECT_EQ(impinge(folder, {"clash", "a.off", "g.off", "--bcf", "out.bcf", "--quiet"}).code, 0);
  EXPECT_TRUE(topics().empty());
}

TEST_F(Bcf, AnyNameIsHarmless) {
  const std::string nasty = "<Title><x a=\"&amp;\x1b[2J\n\xff\xEF\xBF\xBE\xE2\x80\xAE" + std::string(150, 'n');
  folder.write(nasty + ".off", off(box({1, 1, 1}, {3, 3, 3})));
  EXPECT_EQ(impinge(folder, {"clash", "a.off", nasty + ".off", "--bcf", "out.bcf", "--quiet"}).code, 1);
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 1U);
  const std::string title = all[0].text("Title");
  EXPECT_TRUE(title.starts_with("a x <Title><x a=\"&amp;\\x1b[2J\\n")) << title;
  EXPECT_LT(title.size(), 300U);
  // XML 1.0 holds neither control characters nor U+FFFE.
  for (const Member& member : unzip(folder.read("out.bcf"))) {
    if (member.name.ends_with(".png")) continue;
    EXPECT_NO_THROW(std::ignore = json(member.bytes).dump()) << member.name << " is no UTF-8";
    EXPECT_EQ(member.bytes.find("\xEF\xBF\xBE"), std::string::npos) << member.name;
    EXPECT_TRUE(std::all_of(member.bytes.begin(), member.bytes.end(), [](unsigned char c) {
      return c == '\n' || (c >= 0x20 && c != 0x7F);
    })) << member.name;
  }
}

TEST_F(Bcf, AndAllOutputsNameTheAxesOfTheGrid) {
  // The clash is at (5.5, 3.5, 1.5) m: nearest are the axes at x = 5 m and y = 4 m.
  std::string ifc = ifc_of_two_walls();
  std::string lines, families[2];
  int line = 100;
  for (const auto& [tag, x, y, to_x, to_y] : {std::tuple("1", 0, -9000, 0, 9000),
                                              {"2", 5000, -9000, 5000, 9000},
                                              {"=3", 9000, -9000, 9000, 9000},
                                              {"A", -9000, 0, 20000, 0},
                                              {"B", -9000, 4000, 20000, 4000}}) {
    lines += fmt::format(
        "#{0}=IFCCARTESIANPOINT(({4}.,{5}.));\n#{1}=IFCCARTESIANPOINT(({6}.,{7}.));\n#{2}=IFCPOLYLINE((#{0},#{1}));\n"
        "#{3}=IFCGRIDAXIS('{8}',#{2},.T.);\n",
        line, line + 1, line + 2, line + 3, x, y, to_x, to_y, tag);
    std::string& family = families[to_x == x ? 0 : 1];
    family += fmt::format("{}#{}", family.empty() ? "" : ",", line + 3);
    line += 4;
  }
  ifc.insert(
      ifc.find("ENDSEC;\nEND-"),
      lines + fmt::format("#98=IFCLOCALPLACEMENT($,#2);\n#99=IFCGRID('3Qvf0xqDT4HXo8jI81mHB9',$,$,$,$,#98,$,({}),({}"
                          "),$);\n",
                          families[0], families[1]));
  folder.write("two.ifc", ifc);
  folder.write("rod.off", off(box({89, -1, 5}, {91, 1, 30})));
  folder.write("ring.off", off(box({88, -2, 10}, {92, 2, 15})));
  const Ended run = impinge(folder, {"clash", "two.ifc", "rod.off", "ring.off", "--scale", "rod.off=100", "--scale",
                                     "ring.off=100", "--bcf", "out.bcf", "--json", "out.json", "--csv", "out.csv"});
  ASSERT_EQ(run.code, 1) << run.err;
  EXPECT_NE(run.out.find("B/2, Level 1, north"), std::string::npos) << run.out;
  const json pairs = json::parse(folder.read("out.json")).at("pairs");
  const std::vector<Row> rows = rows_of(folder.read("out.csv"));
  ASSERT_EQ(pairs.size(), 2U);
  // Without regions no place is known, and the middle of what the boxes share may be by other axes.
  EXPECT_EQ(impinge(folder, {"clash", "two.ifc", "--json", "bare.json"}).code, 1);
  EXPECT_EQ(json::parse(folder.read("bare.json")).at("pairs").at(0).at("axes"), json());
  for (const json& pair : pairs) {
    const bool is_first = pair.at("a") == 0;
    const std::string axes = is_first ? "B/2" : "=3/A";
    EXPECT_EQ(pair.at("axes"), axes);
    const auto row = std::ranges::find_if(rows, [&](const Row& one) { return one.at("id") == pair.at("id"); });
    ASSERT_NE(row, rows.end());
    EXPECT_EQ(row->at("axes"), is_first ? axes : "'" + axes) << "no formula";
    for (const Topic& topic : topics()) {
      if (topic.guid != pair.at("id")) continue;
      const std::string title = topic.text("Title");
      EXPECT_NE(title.find(is_first ? "left x right, B/2, Level 1, north, " : ", =3/A, "), std::string::npos) << title;
      EXPECT_NE(topic.text("Description").find("Axes: " + axes + "\n"), std::string::npos);
    }
  }
}

TEST_F(Bcf, OfAnIfcFileNamesGlobalIdsAndTheFilesOwnAxes) {
  folder.write("two.ifc", ifc_of_two_walls());
  const Ended run = impinge(folder, {"clash", "two.ifc", "--bcf", "out.bcf", "--quiet"});
  ASSERT_EQ(run.code, 1) << run.err;
  const std::vector<Topic> all = topics();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_TRUE(
      std::regex_match(all[0].text("Title"), std::regex("left x right, Level 1, north, (9[0-9]{2}|10[0-9]{2}) mm")))
      << all[0].text("Title");
  EXPECT_EQ(texts(all[0].topic(), "Labels"),
            (std::vector<std::string>{"penetrating", "Level 1, north", "IfcBuildingElementProxy"}));
  const pugi::xml_node components = all[0].view().child("Components");
  const auto guids = [](const pugi::xml_node& list) {
    std::vector<std::string> found;
    for (const pugi::xml_node& component : list.children("Component"))
      found.emplace_back(component.attribute("IfcGuid").value());
    return found;
  };
  const std::vector<std::string> both{"1srAI$R4T8ihLXSNHmUSET", "2O2Fr$t4X7Zf8NOew3FNr2"};
  EXPECT_EQ(guids(components.child("Selection")), both);
  EXPECT_FALSE(components.child("Visibility").attribute("DefaultVisibility").as_bool(true));
  EXPECT_EQ(guids(components.child("Visibility").child("Exceptions")), both);
  // The boxes share (5, 3, 1) to (6, 4, 2): in metres with Z up, as in the file.
  expect_seen(all[0], {5.5, 3.5, 1.5});
  for (const pugi::xml_node& line : all[0].view().child("Lines")) {
    const Vec p = vec(line.child("StartPoint"));
    EXPECT_TRUE(p.x >= 4.999 && p.x <= 6.001 && p.y >= 2.999 && p.y <= 4.001 && p.z >= 0.999 && p.z <= 2.001);
  }
}

}  // namespace
}  // namespace impinge::test
