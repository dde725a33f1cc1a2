// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#define IMPINGE_VERSION_MAJOR 0
#define IMPINGE_VERSION_MINOR 1
#define IMPINGE_VERSION_PATCH 0
#define IMPINGE_VERSION "0.1.0"
