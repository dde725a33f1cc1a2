# Headers of others, and of the standard library, that most files of a target include: parsed once instead of once a file.
# Every file still includes what it uses: release builds and clang-tidy, which go without this, would tell of one in the
# library or the command line that does not.
option(IMPINGE_PRECOMPILE "Precompile the headers that most files include" OFF)

set(IMPINGE_STANDARD_HEADERS <algorithm> <array> <atomic> <bit> <charconv> <cmath> <cstdint> <filesystem> <functional> <limits>
  <map> <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <stop_token> <string> <string_view> <thread>
  <tuple> <unordered_map> <utility> <vector>)

# g++ 12 no longer knows then which lines are the standard library's own, and warns of std::string without cause.
set(IMPINGE_PRECOMPILED_OPTIONS -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)

# impinge_precompile(TARGET header...): the standard headers and these.
function(impinge_precompile target)
  if(IMPINGE_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${IMPINGE_STANDARD_HEADERS} ${ARGN})
    target_compile_options(${target} PRIVATE ${IMPINGE_PRECOMPILED_OPTIONS})
  endif()
endfunction()
