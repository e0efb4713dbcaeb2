#!/usr/bin/env bash
# Makes a Debian package of what `make install` installs: scripts/deb.sh VERSION BUILD_FOLDER.
set -eu
umask 022
version=$1
build=$2
package=povgloss_${version}-1_$(dpkg --print-architecture).deb
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree=$work/tree

make --no-print-directory install PREFIX=/usr DESTDIR="$tree" > "$work/log"
strip "$tree"/usr/bin/*
strip --strip-unneeded "$tree"/usr/lib/povgloss/*
strip --strip-debug "$tree/usr/lib/libgloss.a"
gzip -9n "$tree"/usr/share/man/man*/*

doc=$tree/usr/share/doc/povgloss
mkdir -p "$doc"
{
    printf 'Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n\nFiles: *\n'
    printf 'Copyright: %s\nLicense: Expat\n' "$(sed -n 's/^Copyright (c) //p' LICENSE)"
    sed -n '/^Permission/,$p' LICENSE | sed 's/^$/./; s/^/ /'
} > "$doc/copyright"
cp README.md docs/passes.md "$doc"
{
    printf 'povgloss (%s-1) unstable; urgency=medium\n\n  * Version %s.\n\n' "$version" "$version"
    printf ' -- The povgloss authors <povgloss@packages.invalid>  %s\n' "$(date -R -d "@${SOURCE_DATE_EPOCH:-$(date +%s)}")"
} | gzip -9n > "$doc/changelog.Debian.gz"

mkdir -p "$work/debian" "$tree/DEBIAN"
printf 'Source: povgloss\nPackage: povgloss\nArchitecture: any\n' > "$work/debian/control"
# The window of glossfilter --view is there where SDL2 was; what it needs is recommended.
viewer=()
[ ! -e "$tree/usr/lib/povgloss/view" ] || viewer=(-dRecommends tree/usr/lib/povgloss/view)
(cd "$work" && dpkg-shlibdeps -O tree/usr/bin/* tree/usr/lib/povgloss/preload.so "${viewer[@]}" > libraries 2> log) ||
    { cat "$work/log" >&2; exit 1; }
libraries=$(sed -n 's/^shlibs:Depends=//p' "$work/libraries")
window=$(sed -n 's/^shlibs:Recommends=/, /p' "$work/libraries")
cat > "$tree/DEBIAN/control" << END
Package: povgloss
Version: $version-1
Architecture: $(dpkg --print-architecture)
Maintainer: The povgloss authors <povgloss@packages.invalid>
Installed-Size: $(du -sk --exclude=DEBIAN "$tree" | cut -f1)
Depends: $libraries
Recommends: povray, povray-includes$window
Suggests: bubblewrap, libc6-dev, pkg-config
Section: graphics
Priority: optional
Description: glossy reflections for POV-Ray, without noise
 A POV-Ray scene whose finishes say Gloss(300) is drawn with glossy (fuzzy)
 reflections: POV-Ray renders the mirror image once, and a filter blurs it by
 what each reflected ray hit. The exponent can be changed after the render.
 .
 glossfilter does the same for the passes of any renderer; libgloss is the
 filter for programs.
END
(cd "$tree" && find usr -type f -print0 | sort -z | xargs -0 md5sum) > "$tree/DEBIAN/md5sums"
dpkg-deb --root-owner-group --build "$tree" "$build/$package" > "$work/log"
echo "The package is $build/$package"
