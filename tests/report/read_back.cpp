// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "read_back.hpp"

#include <gtest/gtest.h>
#include <png.h>
#include <zip.h>

#include <array>
#include <charconv>
#include <ctime>
#include <memory>
#include <stdexcept>

namespace impinge::test {
namespace {

void demand(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

}  // namespace

std::vector<Member> unzip(const std::string& archive) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(archive.data(), archive.size(), 0, &error);
  demand(source != nullptr, "no source");
  const std::unique_ptr<zip_t, void (*)(zip_t*)> zip(zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error),
                                                     [](zip_t* z) { zip_discard(z); });
  demand(zip != nullptr, std::string("no zip: ") + zip_error_strerror(&error));
  std::vector<Member> members;
  for (zip_int64_t i = 0; i < zip_get_num_entries(zip.get(), 0); ++i) {
    zip_stat_t about;
    demand(zip_stat_index(zip.get(), static_cast<zip_uint64_t>(i), 0, &about) == 0, "no member");
    Member member;
    member.name = about.name;
    member.bytes.resize(about.size);
    zip_file_t* const file = zip_fopen_index(zip.get(), static_cast<zip_uint64_t>(i), 0);
    demand(file != nullptr, member.name + " cannot be opened");
    const zip_int64_t got = zip_fread(file, member.bytes.data(), about.size);
    char more = 0;
    const zip_int64_t rest = zip_fread(file, &more, 1);  // checks the sum
    demand(zip_fclose(file) == 0 && got == static_cast<zip_int64_t>(about.size) && rest == 0,
           member.name + " cannot be read");
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", std::localtime(&about.mtime));
    member.date = text.data();
    members.push_back(std::move(member));
  }
  return members;
}

void zip(const std::filesystem::path& archive, const std::vector<Member>& members) {
  zip_t* const made = zip_open(archive.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  demand(made != nullptr, "no archive");
  for (const Member& member : members)
    demand(zip_file_add(made, member.name.c_str(), zip_source_buffer(made, member.bytes.data(), member.bytes.size(), 0),
                        0) >= 0,
           member.name + " cannot be added");
  demand(zip_close(made) == 0, "the archive cannot be written");
}

Pixels read_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  demand(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0, image.message);
  image.format = PNG_FORMAT_RGB;
  Pixels pixels{image.width, image.height, std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  demand(png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr) != 0, image.message);
  demand(PNG_IMAGE_FAILED(image) == 0 && image.warning_or_error == 0, image.message);
  return pixels;
}

std::vector<std::vector<std::string>> read_csv(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  std::size_t at = 0;
  while (at < text.size()) {
    std::vector<std::string>& row = rows.emplace_back();
    for (bool more = true; more;) {
      std::string& cell = row.emplace_back();
      if (text.substr(at).starts_with('"')) {
        for (++at; !text.substr(at).starts_with('"') || text.substr(at).starts_with("\"\""); ++at) {
          demand(at < text.size(), "a quote is left open");
          if (text[at] == '"') ++at;
          cell += text[at];
        }
        ++at;
      } else {
        while (at < text.size() && std::string_view("\",\r\n").find(text[at]) == std::string_view::npos)
          cell += text[at++];
      }
      more = text.substr(at).starts_with(',');
      if (more) ++at;
    }
    demand(text.substr(at).starts_with("\r\n"), "no end of a row where one is due: row " + std::to_string(rows.size()));
    at += 2;
  }
  return rows;
}

std::vector<Row> rows_of(std::string_view csv) {
  const auto cells = read_csv(csv);
  std::vector<Row> rows;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].size(), cells[0].size());
    Row& row = rows.emplace_back();
    for (std::size_t k = 0; k < cells[0].size(); ++k) row[cells[0][k]] = cells[i].at(k);
  }
  return rows;
}

double number(const std::string& cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  EXPECT_TRUE(error == std::errc() && end == cell.data() + cell.size()) << cell;
  return value;
}

}  // namespace impinge::test
