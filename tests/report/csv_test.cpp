// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
// `impinge clash --csv`, read back by a reader of RFC 4180.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "models.hpp"
#include "read_back.hpp"
#include "report/writers.hpp"
#include "tests/cli/meshes.hpp"
#include "tests/cli/program.hpp"

namespace impinge::test {
namespace {

using nlohmann::json;

const std::string kHead =
    "rank,verdict,fails,id,a,b,a_path,b_path,a_product,b_product,a_file,b_file,inner,depth,a_in_b_least,"
    "a_in_b_most,b_in_a_least,b_in_a_most,distance,distance_error,regions,area,length,x,y,z,normal_x,normal_y,"
    "normal_z,crossing,touching,coplanar,tolerance,note,test,change,was,new_regions,region,status,comment,"
    "depth_m,distance_m,area_m2,length_m,x_m,y_m,z_m,fails_below,"
    "a_class,b_class,a_global_id,b_global_id,a_tag,b_tag,a_storey,b_storey,assignee,unit,incomplete,"
    "volume,volume_error,volume_m3,depth_least,due,axes\r\n";

class Csv : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("a.off", off(box({0, 0, 0}, {2, 2, 2})));
    folder.write("b.off", off(box({1, 1, 1}, {3, 3, 3})));
    folder.write("big.off", off(box({20, 0, 0}, {26, 6, 6})));
    folder.write("small.off", off(box({22, 2, 2}, {24, 4, 4})));
    folder.write("f.off", off(box({80, 0, 0}, {82, 2, 2})));
    folder.write("g.off", off(box({85, 4, 0}, {87, 6, 2})));
  }
  Folder folder;
};

TEST_F(Csv, SaysWhatTheJsonSaysWorstFirst) {
  const Ended run = impinge(folder, {"clash", "a.off", "b.off", "small.off", "big.off", "f.off", "g.off", "--clearance",
                                     "3.7", "--csv", "out.csv", "--json", "out.json", "--matrix", "m.csv", "--quiet"});
  EXPECT_EQ(run.code, 1) << run.err;
  EXPECT_EQ(folder.read("m.csv"),
            "by,a,b,pairs,fail\r\nfile,a.off,b.off,1,1\r\nfile,big.off,small.off,1,1\r\n"
            "file,f.off,g.off,1,0\r\n");
  EXPECT_TRUE(folder.read("out.csv").starts_with(kHead));
  const std::vector<Row> rows = rows_of(folder.read("out.csv"));
  const json answer = json::parse(folder.read("out.json"));
  std::map<std::string, json> pairs;
  for (const json& pair : answer.at("pairs")) pairs[pair.at("id").get<std::string>()] = pair;
  ASSERT_EQ(rows.size(), pairs.size());
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("verdict"), "inside");
  EXPECT_EQ(rows[1].at("verdict"), "penetrating");
  EXPECT_EQ(rows[2].at("verdict"), "apart");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const json& pair = pairs.at(row.at("id"));
    EXPECT_EQ(row.at("rank"), std::to_string(i + 1));
    EXPECT_EQ(row.at("verdict"), pair.at("verdict"));
    EXPECT_EQ(row.at("fails"), pair.at("fails").get<bool>() ? "true" : "false");
    EXPECT_EQ(row.at("a"), answer.at("objects").at(pair.at("a").get<std::size_t>()).at("name"));
    EXPECT_EQ(row.at("b_file"), answer.at("objects").at(pair.at("b").get<std::size_t>()).at("file"));
    EXPECT_EQ(row.at("regions"), std::to_string(pair.at("regions").size()));
    for (const char* kind : {"crossing", "touching", "coplanar"})
      EXPECT_EQ(row.at(kind), std::to_string(pair.at(kind).get<int>()));
    EXPECT_EQ(number(row.at("tolerance")), pair.at("tolerance").get<double>());
    // The shortest text of a number reads back.
    const auto expect_number = [&](const char* column, const json& value) {
      EXPECT_EQ(row.at(column).empty() ? json() : json(number(row.at(column))), value) << column;
    };
    const auto depth = [&](const char* of, std::size_t end) {
      return pair.at("overlap_depth").is_null() ? json() : pair.at("overlap_depth").at(of).at(end);
    };
    for (const char* column : {"fails_below", "distance", "distance_error"}) expect_number(column, pair.at(column));
    for (const char* of : {"a_in_b", "b_in_a"})
      for (const std::size_t end : {0, 1})
        expect_number((std::string(of) + (end == 0 ? "_least" : "_most")).c_str(), depth(of, end));
    for (const std::size_t axis : {0, 1, 2})
      expect_number(std::array{"normal_x", "normal_y", "normal_z"}[axis],
                    pair.at("regions").empty() ? json() : pair.at("regions").at(0).at("normal").at(axis));
    expect_number("depth_least", std::max(depth("a_in_b", 0), depth("b_in_a", 0)));
  }
  EXPECT_EQ(rows[0].at("inner"), "a");
  EXPECT_EQ(number(rows[0].at("x")), 23) << "the middle of what lies inside";
  EXPECT_EQ(rows[1].at("inner"), "");
  const json& region = pairs.at(rows[1].at("id")).at("regions").at(0);
  EXPECT_EQ(number(rows[1].at("area")), region.at("area").get<double>());
  EXPECT_EQ(number(rows[1].at("y")), region.at("centroid").at(1).get<double>());
  EXPECT_NEAR(number(rows[2].at("x")), 83.5, 1e-12);
}

TEST_F(Csv, OfNothingIsTheNamesOfTheColumns) {
  const Ended run = impinge(folder, {"clash", "a.off", "g.off", "--csv", "-"});
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out, kHead);
}

TEST_F(Csv, AnyNameStaysInItsCellAndRunsNothing) {
  for (const std::string name :
       {"=1+1", "+1", "-1", "@SUM(1)", "\t=1", "\r=1", "a,b", "a\"b", "\"", "a\r\nb", "'quoted'",
        "\xEF\xBC\x9D"
        "1",
        "=cmd|' C calc'!A0", "\x1b[2J", "\xff", "plain"}) {
    folder.write(name + ".off", off(box({1, 1, 1}, {3, 3, 3})));
    const Ended run = impinge(folder, {"clash", "a.off", "./" + name + ".off", "--csv", "-"});
    EXPECT_EQ(run.code, 1) << run.err;
    const std::vector<Row> rows = rows_of(run.out);
    ASSERT_EQ(rows.size(), 1U) << name;
    const std::string& cell = rows[0].at("b");
    EXPECT_EQ(std::string("=+-@\t\r").find(cell.substr(0, 1)), std::string::npos) << cell;
    EXPECT_FALSE(cell.starts_with("\xEF\xBC\x9D"));
    for (const char c : run.out) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\r' || c == '\n');
  }
}

TEST_F(Csv, AndTheJsonSayWhatAnIfcFileSaysOfItsParts) {
  folder.write("two.ifc", ifc_of_two_walls());
  EXPECT_EQ(impinge(folder,
                    {"clash", "two.ifc", "a.off", "--csv", "t.csv", "--json", "t.json", "--matrix", "m.csv", "--quiet"})
                .code,
            1);
  EXPECT_EQ(folder.read("m.csv"),
            "by,a,b,pairs,fail\r\nfile,two.ifc,two.ifc,1,1\r\n"
            "class,IfcBuildingElementProxy,IfcBuildingElementProxy,1,1\r\n"
            "storey,\"Level 1, north\",\"Level 1, north\",1,1\r\n");
  const std::vector<Row> rows = rows_of(folder.read("t.csv"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].at("verdict"), "warning") << "about the unit of a.off";
  const json walls = json::parse(R"([
      {"class":"IfcBuildingElementProxy","GlobalId":"1srAI$R4T8ihLXSNHmUSET","Tag":"-7","storey":"Level 1, north","building":"House","site":"Site","material":["brick","mortar"]},
      {"class":"IfcBuildingElementProxy","GlobalId":"2O2Fr$t4X7Zf8NOew3FNr2","ObjectType":"type","storey":"Level 1, north","building":"House","site":"Site","material":"steel"},
      {}])");
  const json answer = json::parse(folder.read("t.json")), &objects = answer.at("objects");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(objects.at(i).at("properties"), walls.at(i));
  for (const std::string side : {"a", "b"})
    for (const char* of : {"path", "product"})
      EXPECT_EQ(rows[0].at(side + "_" + of), objects.at(answer.at("pairs").at(0).at(side).get<std::size_t>()).at(of))
          << side << "_" << of;
  for (const auto& [column, value] : Row{{"a_class", walls[0]["class"]},
                                         {"b_class", walls[1]["class"]},
                                         {"a_global_id", walls[0]["GlobalId"]},
                                         {"b_global_id", walls[1]["GlobalId"]},
                                         {"a_tag", "'-7"},
                                         {"b_tag", ""},
                                         {"b_storey", "Level 1, north"}})
    EXPECT_EQ(rows[0].at(column), value) << column;
}

/// A table that a spreadsheet saved: with words typed into the columns of one pair.
TEST_F(Csv, BringsDecisionsBackAndIsNotReplacedByOneThatKnowsLess) {
  const auto clash = [&](std::vector<std::string> files, const std::vector<std::string>& more) {
    files.insert(files.begin(), "clash"), files.insert(files.end(), {"--csv", "t.csv"});
    files.insert(files.end(), more.begin(), more.end());
    return impinge(folder, files);
  };
  const std::vector<std::string> both{"a.off", "b.off", "small.off", "big.off"}, one{"small.off", "big.off"};
  EXPECT_EQ(clash(both, {}).code, 1);
  const std::vector<Row> rows = rows_of(folder.read("t.csv"));
  ASSERT_EQ(rows.size(), 2U);
  const std::string id = rows[1].at("id");
  folder.write("saved.csv",
               "\xEF\xBB\xBF"
               "comment;id;status;assignee;due\n\"'-3 mm; see \"\"A\"\"\";" +
                   id + ";approved;Ann;2024-02-29\n;" + rows[0].at("id") + ";;;\n");
  EXPECT_EQ(clash(both, {"--decisions", "saved.csv"}).code, 1);
  const std::string decided = folder.read("t.csv");
  EXPECT_EQ(rows_of(decided)[0].at("status"), "");
  EXPECT_EQ(rows_of(decided)[1].at("status"), "approved");
  EXPECT_EQ(rows_of(decided)[1].at("comment"), "'-3 mm; see \"A\"");
  EXPECT_EQ(rows_of(decided)[1].at("assignee"), "Ann");
  EXPECT_EQ(rows_of(decided)[1].at("due"), "2024-02-29");

  const auto is_refused = [&](const Ended& ended) {
    EXPECT_EQ(folder.read("t.csv"), decided);
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("t.csv holds 1 decision that would be lost, the first about the pair " + id),
              std::string::npos)
        << ended.err;
  };
  is_refused(clash(both, {}));
  EXPECT_EQ(clash(both, {"--decisions", "saved.csv"}).code, 1);
  // Where the pair is gone, another file may still tell what was decided.
  is_refused(clash(one, {}));
  const std::string same =
      R"({"a | b":{"status":"approved","comment":"-3 mm; see \"A\"","assignee":"Ann","due":"2024-02-29"}})";
  std::string other = same;
  folder.write("d.json", other.replace(other.find("Ann"), 3, "Bob"));
  is_refused(clash(one, {"--decisions", "d.json"}));
  folder.write("d.json", same);
  EXPECT_EQ(clash(one, {"--decisions", "d.json"}).code, 1);
  folder.write("t.csv", decided);
  EXPECT_EQ(clash(both, {"--force"}).code, 1);
  EXPECT_EQ(rows_of(folder.read("t.csv"))[1].at("status"), "");

  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"",
            "bad.csv:1: a table of decisions needs the column 'id' and at least one of 'status', 'comment', "
            "'assignee', 'due'"},
           {"id,area\n", "bad.csv:1: a table of decisions needs the column"},
           {"id,due\n01234567-89ab-5cde-8f01-23456789abcd,2023-02-29\n",
            "bad.csv:2: the cell under 'due' is no day such as 2024-06-14: '2023-02-29'"},
           {"id,status\n,\n7,open\n", "bad.csv:3: the cell under 'id' is no id of a pair: '7'"},
           {"id,status\n" + id + ",a\n" + id + ",b\n", "bad.csv:3: another row decides otherwise"}}) {
    folder.write("bad.csv", text);
    const Ended ended = impinge(folder, {"clash", "a.off", "--decisions", "bad.csv"});
    EXPECT_EQ(ended.code, 2) << text;
    EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
  }
}

TEST(CsvCell, IsDefusedByAnApostropheAlone) {
  EXPECT_EQ(report::csv_cell("bolt"), "bolt");
  EXPECT_EQ(report::csv_cell(""), "");
  EXPECT_EQ(report::csv_cell("=1"), "'=1");
  EXPECT_EQ(report::csv_cell("a=1"), "a=1");
  EXPECT_EQ(report::csv_cell("-3"), "'-3");
  EXPECT_EQ(report::csv_cell("'a"), "''a");
  EXPECT_EQ(report::csv_cell("@a,b"), "\"'@a,b\"");
  EXPECT_EQ(report::csv_cell("a\"b"), "\"a\"\"b\"");
  EXPECT_EQ(report::csv_cell("a\nb"), "a\\nb");
}

}  // namespace
}  // namespace impinge::test
