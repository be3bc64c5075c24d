#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the manual page of a program from its --help.
#   make_man_page.sh PROGRAM WHAT_IT_DOES PAGE.1 OTHER_PROGRAM...
set -eu
program=$1 name=$(basename "$1") what=$2 page=$3
shift 3
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

if [ $# -gt 0 ]; then
  echo "[see also]" >"$work/see_also"
fi
while [ $# -gt 0 ]; do
  echo ".BR $1 (1)$([ $# -eq 1 ] || echo ,)" >>"$work/see_also"
  shift
done

help2man --no-info --name "$what" --opt-include "$work/see_also" "$work/$name" >"$page.part"
mv "$page.part" "$page"
