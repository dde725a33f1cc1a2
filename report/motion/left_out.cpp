// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstddef>

#include "report/motion/motion_report.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

std::string named(const io::Animation& animation) {
  return animation.name.empty() ? "the animation without a name"
                                : fmt::format("animation '{}'", printable(animation.name));
}

/// For each node whether it or a node below it shows a part.
std::vector<bool> nodes_with_parts(const io::Model& model) {
  std::vector<bool> have(model.nodes.size(), false);
  for (const io::Object& object : model.objects)
    if (object.node) have[*object.node] = true;
  for (std::size_t i = have.size(); i-- > 0;)  // parents come first
    if (have[i] && model.nodes[i].parent) have[*model.nodes[i].parent] = true;
  return have;
}

/// The parts whose shape changes; each once.
std::vector<std::string> changed_shapes(const io::Model& model, const io::Animation& animation,
                                        const Assembly& assembly) {
  std::vector<std::string> why(model.nodes.size()), sentences;
  for (const io::Unfollowed& lost : animation.unfollowed) {
    if (lost.what != io::Unfollowed::What::shape) continue;
    if (lost.node)
      why[*lost.node] = lost.sentence;
    else
      sentences.push_back(
          fmt::format("{} changes the shape of a part, it is not known of which, which keeps its shape "
                      "here: {}",
                      named(animation), printable(lost.sentence)));
  }
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    const auto node = model.objects[i].node;
    if (node && !why[*node].empty())
      sentences.push_back(fmt::format("{} changes the shape of part '{}', which keeps its shape here: {}",
                                      named(animation), assembly.labels[i], printable(why[*node])));
  }
  return sentences;
}

}  // namespace

Result<LeftOut> left_out(const io::Model& model, const io::Animation& animation, const Assembly& assembly) {
  const std::string& file = assembly.files.front();
  const std::vector<bool> have = nodes_with_parts(model);
  const io::Unfollowed* first = nullptr;
  std::size_t others = 0;
  LeftOut left;
  for (const io::Unfollowed& lost : animation.unfollowed) {
    if (lost.what != io::Unfollowed::What::place) continue;
    if (lost.node && !have[*lost.node])
      left.harmless.push_back(fmt::format("{} has a channel that cannot be followed, but moves no part: {}",
                                          named(animation), printable(lost.sentence)));
    else if (first == nullptr)
      first = &lost;
    else
      ++others;
  }
  if (first != nullptr)
    return Error{Code::bad_file,
                 fmt::format("{}: {} cannot be run: {}{}; mend it where the file is made{}", file, named(animation),
                             printable(first->sentence),
                             others > 0 ? fmt::format(", and so with {}", counted(others, "more channel")) : "",
                             model.animations.size() > 1 ? ", or choose another by --animation" : "")};
  left.shapes = changed_shapes(model, animation, assembly);
  if (animation.seconds > 0) return left;
  const std::string why = !left.shapes.empty()     ? left.shapes.front()
                          : !left.harmless.empty() ? left.harmless.front()
                                                   : named(animation) + " changes the shape of what is no part";
  return Error{Code::bad_file, fmt::format("{}: nothing moves in it: {}", file, why)};
}

}  // namespace impinge::report
