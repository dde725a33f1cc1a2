#!/usr/bin/env bash
# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# no_contraction_test.sh LEAST SHADER.spv...: in compiled shaders, every sum, difference and product of floats must be
# marked NoContraction, so that no driver fuses them, and nothing may be there whose rounding Vulkan leaves open. LEAST:
# how many marks there are at least in all.
set -euo pipefail
least=$1
shift
marks=0
for shader in "$@"; do
  text=$(spirv-dis --raw-id "$shader")
  marks=$((marks + $(grep -c ' NoContraction$' <<<"$text" || true)))
  bare=$(awk '$1 == "OpDecorate" && $3 == "NoContraction" { marked[$2] = 1 }
              $3 ~ /^OpF(Add|Sub|Mul)$/ && !marked[$1] { print $1 }' <<<"$text")
  if [ -n "$bare" ]; then
    echo "$shader: not marked NoContraction:" $bare
    exit 1
  fi
  if grep -nE 'OpFDiv|OpDot|OpFRem|OpFMod|OpMatrixTimes|OpVectorTimes|OpOuterProduct|RelaxedPrecision| (Fma|Sqrt|InverseSqrt|Pow|Exp|Normalize|Cross|Length|Distance|FMix|Ldexp)( |$)' <<<"$text"; then
    echo "$shader: has arithmetic whose rounding Vulkan leaves open"
    exit 1
  fi
done
echo "$marks marks"
[ "$marks" -ge "$least" ]
