#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the manual page of a program from its --help.
#   make_man_page.sh PROGRAM WHAT_IT_DOES SEE_ALSO.h2m PAGE.1
set -eu
program=$1 name=$(basename "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# What help2man looks for: options as GNU's programs print them, headings between stars, examples after a prompt.
"$program" --help | sed -E \
  -e 's/^  -([a-zA-Z]) \[ --([a-z-]+) \]( [^ ]+)?  ?/  -\1, --\2\3  /' \
  -e 's/^(Keys in the window|Examples|Exit status):$/*\1*/' \
  -e 's/^(Exit status): (.*)$/*\1*\n\2/' \
  -e "s/^  ($name .*)/  \$ \1/" >"$work/help"
"$program" --version >"$work/version"
cat >"$work/$name" <<'END'
#!/bin/sh
cat "$(dirname "$0")/${1#--}"
END
chmod +x "$work/$name"

help2man --no-info --name "$2" --include "$3" "$work/$name" >"$4.part"
mv "$4.part" "$4"
