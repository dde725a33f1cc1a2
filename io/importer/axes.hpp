// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

struct aiScene;

namespace impinge::importer {

/// The name of the assimp reader that made a scene, as in "Collada Importer".
std::string reader_of(const aiScene& scene);

/// How many metres one of the coordinates' units has: 1 where the format has metres (glTF) or the reader converts to
/// them (COLLADA), what the file says of FBX, and nothing of other formats.
std::optional<double> unit_in_metres(const aiScene& scene);

/// Sentences on how the reader's coordinates differ from the file's: turned axes, changed units.
/// Of assimp 5.2: the COLLADA reader, and those of the older formats with Z up, put a matrix at the root that makes Y
/// the upward axis; that of COLLADA converts to metres in the same matrix. The glTF, FBX, X, LightWave and Quick3D
/// readers leave axes and units as they are: what stands at their root is the file's own.
std::vector<std::string> axis_warnings(const aiScene& scene);

}  // namespace impinge::importer
