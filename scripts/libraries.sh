# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
#
# Functions of bundle.sh and wheel.sh: the shared libraries that a program brings along, with their licences. Who sources this
# defines `fail SENTENCE` and the folder `licences`.
# shellcheck shell=bash

# What the host has of its own. A GPU's driver does not load without the host's libstdc++ and libgcc_s.
is_of_the_host() {
  case $1 in
    linux-vdso.so.* | ld-linux*.so.* | libc.so.6 | libm.so.6 | libdl.so.2 | libpthread.so.0 | librt.so.1) ;;
    libstdc++.so.6 | libgcc_s.so.1) ;;
    *) return 1 ;;
  esac
}

is_elf() { [ "$(head -c 4 "$1" | tail -c 3)" = ELF ]; }

# needs_of FILE: the names of the libraries that it asks for itself.
needs_of() { readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'; }

# bring_libraries PROGRAM FOLDER: all that the program needs, and what those need in turn.
bring_libraries() {
  local library arrow path rest
  mkdir -p "$2"
  while read -r library arrow path rest; do
    if is_of_the_host "$(basename "$library")" || [ -f "$2/$library" ]; then continue; fi
    if [ "$arrow" != '=>' ] || [ ! -f "$path" ]; then fail "$1 needs $library, which is not on this machine"; fi
    cp -L "$path" "$2/$library"
    chmod 644 "$2/$library"
    bring_licence "$path"
  done < <(env -u LD_LIBRARY_PATH ldd "$1")
}

# bring_licence FILE: of the Debian package that the file belongs to, and those that it speaks of.
bring_licence() {
  local package file notice common
  file=$(readlink -f "$1")
  # Where /lib is a link to /usr/lib, packages know their files by either name.
  package=$(dpkg -S "$file" 2>/dev/null || dpkg -S "${file#/usr}" 2>/dev/null || true)
  package=${package%%:*}
  notice=/usr/share/doc/$package/copyright
  if [ -z "$package" ] || [ ! -f "$notice" ]; then fail "no licence was found for $1"; fi
  cp "$notice" "$licences/$package.txt"
  while read -r common; do
    cp -L "$common" "$licences/$(basename "$common").txt"
  done < <(grep -oE '/usr/share/common-licenses/[A-Za-z0-9.+-]*[A-Za-z0-9]' "$notice" | sort -u)
}

# newest PREFIX FOLDER: the newest version of the host's library that any file there asks for, GLIBC's or another's.
newest() {
  local file
  while read -r -d '' file; do
    if is_elf "$file"; then readelf --version-info -W "$file"; fi
  done < <(find "$2" -type f -print0) |
    grep -oE "\b$1_[0-9.]+" | sort -uV | tail -n 1 | sed "s/^$1_//"
}

# check_origin PROGRAM FOLDER: the loader finds in the folder whatever is not the host's.
check_origin() {
  local library path
  while read -r library _ path _; do
    if is_of_the_host "$(basename "$library")"; then continue; fi
    [ "${path#"$2/"}" != "$path" ] || fail "$1 takes $library from $path, not from $2"
  done < <(ldd "$1")
}
