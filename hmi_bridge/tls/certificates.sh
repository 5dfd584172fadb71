#!/usr/bin/env bash
# certificates.sh FOLDER SERVER CLIENT...: an authority of your own and certificates of it, where there are none yet.
# SERVER and CLIENT are names: SERVER.crt and .key are for the machine of that name, CLIENT.crt and .key for panels. ca.key
# signs further ones: keep it off both machines. certificates.sh --revoke FOLDER CLIENT takes one back.
set -euo pipefail
umask 077
readonly DAYS=3650

fail() {
  printf 'certificates.sh: %s\n' "$*" >&2
  exit 2
}

# What openssl keeps of an authority: what it has signed, and what it has taken back.
authority() {
  [[ -e index.txt ]] || : >index.txt
  [[ -e serial ]] || echo 01 >serial
  [[ -e crlnumber ]] || echo 01 >crlnumber
  cat >ca.conf <<'CONF'
[ca]
default_ca = own
[own]
dir = .
database = index.txt
serial = serial
crlnumber = crlnumber
new_certs_dir = .
certificate = ca.crt
private_key = ca.key
default_md = sha256
default_crl_days = 3650
policy = any
unique_subject = no
[any]
commonName = supplied
[root]
basicConstraints = critical, CA:TRUE
keyUsage = critical, keyCertSign, cRLSign
subjectKeyIdentifier = hash
[server]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature
extendedKeyUsage = serverAuth
subjectAltName = DNS:${ENV::NAME}
[client]
basicConstraints = critical, CA:FALSE
keyUsage = critical, digitalSignature
extendedKeyUsage = clientAuth
subjectAltName = DNS:${ENV::NAME}
CONF
}

new_key() {
  openssl genpkey -quiet -algorithm EC -pkeyopt ec_paramgen_curve:P-256 -out "$1.key"
}

# certify NAME KIND
certify() {
  [[ ! -e $1.crt ]] || return 0
  new_key "$1"
  openssl req -new -key "$1.key" -subj "/CN=$1" -out "$1.csr"
  NAME=$1 openssl ca -batch -notext -config ca.conf -extensions "$2" -days "$DAYS" -in "$1.csr" -out "$1.crt" 2>/dev/null
  rm "$1.csr"
}

revoke=no
if [[ ${1-} == --revoke ]]; then
  revoke=yes
  shift
fi
(($# >= 2)) || fail 'needs a folder, a server and any clients'
mkdir -p "$1"
cd "$1"
shift
for name; do [[ $name =~ ^[A-Za-z0-9][A-Za-z0-9.-]*$ ]] || fail "'$name' is no name of a machine"; done
export NAME=none
authority
if [[ ! -e ca.crt ]]; then
  new_key ca
  openssl req -x509 -new -config <(printf '[req]\ndistinguished_name = dn\n[dn]\n'; sed -n '/^\[root\]/,/^\[server\]/p' ca.conf | sed '$d') \
    -extensions root -key ca.key -days "$DAYS" -subj '/CN=Lockstep Modbus' -out ca.crt
fi
if [[ $revoke == yes ]]; then
  for name; do openssl ca -batch -config ca.conf -revoke "$name.crt" 2>/dev/null; done
else
  certify "$1" server
  shift
  for name; do certify "$name" client; done
fi
openssl ca -batch -config ca.conf -gencrl -out ca.crl 2>/dev/null
chmod 644 ./*.crt ca.crl
