# SPDX-License-Identifier: Apache-2.0
# Sourced: a Debian 12 that has never seen lightcal, as a chroot. Root only. The mirror is the one
# this machine's apt uses.
#   make_clean_root FOLDER    FOLDER/root, new; FOLDER/base.tar is kept and reused for the base system
#   in_root COMMAND...        runs it in there
#   remove_root FOLDER        takes one away

# A folder away, whatever a run that was killed left mounted in it: never through a mount.
remove_root() {
  findmnt --noheadings --list --output TARGET | { grep "^$1/" || true; } | sort -r | xargs -r umount
  rm -rf --one-file-system "$1"
}

make_clean_root() {
  local folder base mirror
  folder=$(realpath -m "$1")
  base=$folder/base.tar
  mirror=$(apt-get indextargets --format '$(SITE) $(RELEASE)' | awk '$2 == "bookworm" {print $1; exit}')
  root=$folder/root
  mkdir -p "$folder"
  if [ ! -s "$base" ]; then
    remove_root "$folder/base"
    debootstrap --variant=minbase bookworm "$folder/base" "$mirror" >"$folder/debootstrap.log"
    tar -C "$folder/base" -cf "$base" .
    remove_root "$folder/base"
  fi
  remove_root "$root"
  mkdir -p "$root"
  tar -C "$root" -xf "$base"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  # The proxy or mirror settings of this machine's apt, if it has any.
  cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2>/dev/null || true
  # debootstrap made device nodes of its own: no door to this machine's /dev.
  mount -t proc proc "$root/proc"
  trap 'umount --lazy "$root/proc"' EXIT
}

in_root() {
  chroot "$root" /usr/bin/env HOME=/root TERM=dumb DEBIAN_FRONTEND=noninteractive \
    http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" "$@"
}
