#!/usr/bin/env python3
"""Runs `gsv run --ros2` with an SROS2 keystore: participants with keys are accepted, and others are not.

  ros2_security_test.py GSV ROS2_PEER ROS2_FAST_CLIENT PLUGIN_FOLDER

openssl makes the keystore, in the form of `ros2 security create_keystore` and `create_enclave`. ROS2_FAST_CLIENT uses
Fast DDS and takes the same ROS_SECURITY variables as GSV. ROS2_PEER uses Cyclone DDS, without keys: Debian has no
plug-ins for its security.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from domains import take_domain

GSV, PEER, FAST_CLIENT, PLUGINS = sys.argv[1:5]
os.environ.setdefault("ASAN_OPTIONS", "new_delete_type_mismatch=0")
DOMAIN = str(take_domain())

GOVERNANCE = """<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
 xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
<domain_access_rules><domain_rule><domains><id_range><min>0</min><max>230</max></id_range></domains>
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>SIGN</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT</metadata_protection_kind><data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
"""
PERMISSIONS = """<?xml version="1.0" encoding="UTF-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
 xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
<permissions><grant name="{enclave}"><subject_name>CN={enclave}</subject_name>
<validity><not_before>2013-10-26T00:00:00</not_before><not_after>2037-10-26T22:45:30</not_after></validity>
<allow_rule><domains><id>{domain}</id></domains><publish><topics><topic>*</topic></topics></publish>
<subscribe><topics><topic>*</topic></topics></subscribe></allow_rule><default>DENY</default></grant></permissions></dds>
"""


def openssl(*words):
    subprocess.run(["openssl", *words], check=True, capture_output=True)


class Keystore:
    """A certificate authority, and enclaves with the keys that it signed."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.authority = self.folder / "ca.cert.pem"
        self.authority_key = self.folder / "ca.key.pem"
        self.make_key(self.authority_key)
        openssl("req", "-x509", "-new", "-key", str(self.authority_key), "-sha256", "-days", "3650", "-subj", "/CN=sros2CA",
                "-out", str(self.authority))

    @staticmethod
    def make_key(path):
        openssl("ecparam", "-name", "prime256v1", "-genkey", "-noout", "-out", str(path))

    def sign(self, text, target):
        source = target.with_suffix(".xml")
        source.write_text(text, encoding="utf-8")
        openssl("smime", "-sign", "-text", "-in", str(source), "-out", str(target), "-signer", str(self.authority),
                "-inkey", str(self.authority_key))

    def add(self, enclave):
        folder = self.folder / "enclaves" / enclave.lstrip("/")
        folder.mkdir(parents=True)
        self.make_key(folder / "key.pem")
        request = folder / "request.pem"
        openssl("req", "-new", "-key", str(folder / "key.pem"), "-subj", f"/CN={enclave}".replace("/CN=/", "/CN=\\/"),
                "-out", str(request))
        openssl("x509", "-req", "-in", str(request), "-CA", str(self.authority), "-CAkey", str(self.authority_key),
                "-CAcreateserial", "-sha256", "-days", "3650", "-out", str(folder / "cert.pem"))
        for name in ("identity_ca.cert.pem", "permissions_ca.cert.pem"):
            (folder / name).write_bytes(self.authority.read_bytes())
        self.sign(GOVERNANCE, folder / "governance.p7s")
        self.sign(PERMISSIONS.format(enclave=enclave, domain=DOMAIN), folder / "permissions.p7s")
        return folder

    def environment(self, enclave, strategy="Enforce"):
        return {**os.environ, "ROS_DOMAIN_ID": DOMAIN, "ROS_SECURITY_ENABLE": "true",
                "ROS_SECURITY_STRATEGY": strategy, "ROS_SECURITY_KEYSTORE": str(self.folder),
                "ROS_SECURITY_ENCLAVE_OVERRIDE": enclave}


@unittest.skipUnless(shutil.which("openssl"), "openssl is not installed, so no keystore can be made")
class Security(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="gsv-sros2-")
        cls.keys = Keystore(pathlib.Path(cls.folder.name, "keys"))
        cls.keys.add("/gsv")
        cls.keys.add("/client")
        other = Keystore(pathlib.Path(cls.folder.name, "others"))
        other.add("/client")
        cls.other_keys = other

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_hears_who_has_keys_and_nobody_else(self):
        gsv = subprocess.Popen([GSV, "run", "office", "--robot", "pebble", "--ros2", "--headless"],
                               env=self.keys.environment("/gsv"), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            line = next(line for line in gsv.stdout if line.startswith("ros2:"))
            self.assertIn("with the keys of an SROS2 enclave", line)
            call = [FAST_CLIENT, PLUGINS, "pebble", "20", "5"]
            called = subprocess.run(call, env=self.keys.environment("/client"), capture_output=True, text=True, check=False)
            self.assertEqual(json.loads(called.stdout), {"calls": 20, "replies": 20}, called.stderr)
            topics = [GSV, "ros2", "topics", "--seconds", "4"]
            with_keys = subprocess.run(topics, env=self.keys.environment("/client"), capture_output=True, text=True, check=True)
            self.assertIn("/pebble/odom [nav_msgs/msg/Odometry]", with_keys.stdout)
            without = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
            for environment in (without, self.other_keys.environment("/client")):
                seen = subprocess.run(topics, env=environment, capture_output=True, text=True, check=True)
                self.assertNotIn("/pebble/odom", seen.stdout)
            listen = [PEER, "listen", "nav_msgs/msg/Odometry:/pebble/odom", "--domain", DOMAIN, "--timeout", "4"]
            self.assertEqual(subprocess.run(listen, capture_output=True, check=False).returncode, 1)
        finally:
            gsv.terminate()
            gsv.communicate(timeout=30)

    def start(self, environment):
        return subprocess.run([GSV, "ros2", "topics", "--seconds", "0.1"], env=environment, capture_output=True, text=True,
                              check=False)

    def test_does_not_start_without_the_keys_that_are_enforced(self):
        done = self.start(self.keys.environment("/unknown"))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("ROS_SECURITY_KEYSTORE: there is no identity_ca.cert.pem in", done.stderr)
        without = {**self.keys.environment("/gsv"), "ROS_SECURITY_KEYSTORE": ""}
        self.assertIn("ROS_SECURITY_KEYSTORE: is not set, but ROS_SECURITY_ENABLE is", self.start(without).stderr)

    def test_warns_where_security_is_permitted_but_impossible(self):
        done = self.start(self.keys.environment("/unknown", "Permissive"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("ROS 2 runs without security: ", done.stderr)

    def test_refuses_keys_that_do_not_fit(self):
        folder = self.keys.add("/broken")
        (folder / "key.pem").write_text("no key", encoding="ascii")
        done = self.start(self.keys.environment("/broken"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("Fast DDS refuses the keys or the permissions for domain " + DOMAIN, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[5:]])
