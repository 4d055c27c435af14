"""A test authority for DDS Security: its CA, the governance of domains, each participant's files.

Source: OMG DDS Security 1.1 (formal/2018-04-01), 9.3 (certificates), 9.4 (governance and permissions, S/MIME signed).
"""

import os
from collections.abc import Sequence
from datetime import UTC, datetime, timedelta
from pathlib import Path
from xml.sax.saxutils import escape

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.hazmat.primitives.serialization import pkcs7
from cryptography.x509.oid import NameOID

from libins.errors import UsageError

ORGANIZATION = "libins test authority"
DOMAIN_MAX = 230
"""Cyclone DDS 0.10 accepts no governance above."""
SLACK = timedelta(days=1)
"""Validity begins so long ago: clocks differ."""
COMMON_NAME_MAX = 64
"""X.520, ub-common-name."""
NAMESPACE = "http://www.w3.org/2001/XMLSchema-instance"
GOVERNANCE = f"""<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="{NAMESPACE}" xsi:noNamespaceSchemaLocation="omg_shared_ca_domain_governance.xsd">
<domain_access_rules><domain_rule>
<domains><id_range><min>0</min><max>{DOMAIN_MAX}</max></id_range></domains>
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>SIGN</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection><enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control><enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>SIGN</metadata_protection_kind><data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
"""


def _pem(certificate: x509.Certificate) -> bytes:
    return certificate.public_bytes(serialization.Encoding.PEM)


def _pem_key(key: ec.EllipticCurvePrivateKey) -> bytes:
    return key.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )


def _name(common: str) -> x509.Name:
    return x509.Name(
        [
            x509.NameAttribute(NameOID.ORGANIZATION_NAME, ORGANIZATION),
            x509.NameAttribute(NameOID.COMMON_NAME, common),
        ]
    )


def _put(path: Path, octets: bytes, mode: int = 0o644) -> None:
    """Whole or not at all, and a key never readable to others."""
    part = path.with_name(path.name + ".part")
    descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, mode)
    with os.fdopen(descriptor, "wb") as file:
        file.write(octets)
    part.rename(path)


class Authority:
    """The CA in folder/ca; made when it is not there. It signs certificates, governance and permissions."""

    def __init__(self, folder: Path, days: int) -> None:
        self.folder = folder
        self.now = datetime.now(UTC)
        self.end = self.now + timedelta(days=days)
        certificate, key = folder / "ca" / "ca.pem", folder / "ca" / "ca_key.pem"
        if certificate.exists() != key.exists():
            raise UsageError(f"{folder}/ca: ca.pem and ca_key.pem belong together; one is missing: remove the folder")
        if key.exists():
            try:
                loaded = serialization.load_pem_private_key(key.read_bytes(), None)
                self.certificate = x509.load_pem_x509_certificate(certificate.read_bytes())
            except (ValueError, OSError) as error:
                raise UsageError(f"{folder}/ca: cannot be read: {error}") from error
            if not isinstance(loaded, ec.EllipticCurvePrivateKey):
                raise UsageError(f"{key}: is not a key of an elliptic curve, as ins keys makes them")
            self.key = loaded
            return
        self.key = ec.generate_private_key(ec.SECP256R1())
        self.certificate = self._certificate(_name("ca"), self.key, True)
        (folder / "ca").mkdir(parents=True, exist_ok=True)
        _put(key, _pem_key(self.key), 0o600)
        _put(certificate, _pem(self.certificate))

    def _certificate(self, subject: x509.Name, key: ec.EllipticCurvePrivateKey, is_ca: bool) -> x509.Certificate:
        issuer = subject if is_ca else self.certificate.subject
        builder = (
            x509.CertificateBuilder()
            .subject_name(subject)
            .issuer_name(issuer)
            .public_key(key.public_key())
            .serial_number(x509.random_serial_number())
            .not_valid_before(self.now - SLACK)
            .not_valid_after(self.end)
            .add_extension(x509.BasicConstraints(ca=is_ca, path_length=None), critical=True)
        )
        return builder.sign(self.key, hashes.SHA256())

    def signed(self, document: str) -> bytes:
        """As S/MIME with the text in clear."""
        builder = (
            pkcs7.PKCS7SignatureBuilder()
            .set_data(document.encode())
            .add_signer(self.certificate, self.key, hashes.SHA256())
        )
        return builder.sign(
            serialization.Encoding.SMIME, [pkcs7.PKCS7Options.DetachedSignature, pkcs7.PKCS7Options.Text]
        )

    def permissions(self, subject: x509.Name, publish: Sequence[str], subscribe: Sequence[str]) -> str:
        def rule(kind: str, topics: Sequence[str]) -> str:
            names = "".join(f"<topic>{escape(topic)}</topic>" for topic in topics)
            return f"<{kind}><topics>{names}</topics></{kind}>" if topics else ""

        start, end = ((self.now - SLACK).strftime("%Y-%m-%dT%H:%M:%S"), self.end.strftime("%Y-%m-%dT%H:%M:%S"))
        return f"""<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="{NAMESPACE}" xsi:noNamespaceSchemaLocation="omg_shared_ca_permissions.xsd"><permissions>
<grant name="{escape(str(subject.get_attributes_for_oid(NameOID.COMMON_NAME)[0].value))}">
<subject_name>{escape(subject.rfc4514_string())}</subject_name>
<validity><not_before>{start}</not_before><not_after>{end}</not_after></validity>
<allow_rule><domains><id_range><min>0</min><max>{DOMAIN_MAX}</max></id_range></domains>
{rule("publish", publish)}{rule("subscribe", subscribe)}</allow_rule>
<default>DENY</default></grant></permissions></dds>
"""

    def participant(self, name: str, publish: Sequence[str], subscribe: Sequence[str]) -> Path:
        """The six files of ins_dds_security_t, in a folder of their own. Raises UsageError."""
        if not name or len(name) > COMMON_NAME_MAX or name == "ca" or not all(c.isalnum() or c in "-_" for c in name):
            raise UsageError(
                f"participant '{name}': letters, digits, - and _ make its name, {COMMON_NAME_MAX} at most, not 'ca'"
            )
        if not publish and not subscribe:
            raise UsageError(f"participant '{name}': may neither publish nor subscribe; give --publish or --subscribe")
        subject, key = _name(name), ec.generate_private_key(ec.SECP256R1())
        folder = self.folder / name
        folder.mkdir(parents=True, exist_ok=True)
        _put(folder / "key.pem", _pem_key(key), 0o600)
        _put(folder / "certificate.pem", _pem(self._certificate(subject, key, False)))
        for authority in ("identity_ca.pem", "permissions_ca.pem"):
            _put(folder / authority, _pem(self.certificate))
        _put(folder / "governance.p7s", self.signed(GOVERNANCE))
        _put(folder / "permissions.p7s", self.signed(self.permissions(subject, publish, subscribe)))
        return folder
