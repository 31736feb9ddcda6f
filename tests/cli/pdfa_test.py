#!/usr/bin/env python3
"""Sheets for patent offices as PDF/A-1b (ISO 19005-1): pdfa_test.py BURIN SCENES

Debian has no validator of PDF/A. So what the standard asks of a file that has lines only is looked up here in what
qpdf reads of it: the header, the identifier, the output intent and its profile, the metadata, which graphics operators
there are, the limits of numbers, and what must not be there: encryption, optional content, transparency, actions,
fonts, images, compressed objects.
"""
import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

OPERATORS = set("w J j M d cm q Q m l c v y h re S s f F f* B B* b b* n W W* G g RG rg".split())
FORBIDDEN = {"/OCProperties", "/OC", "/SMask", "/AA", "/OpenAction", "/JavaScript", "/Encrypt", "/EmbeddedFiles", "/AF",
             "/Font", "/XObject", "/Shading", "/Pattern", "/Group", "/BM", "/F", "/FFilter", "/Alternates", "/OPI"}


def values(node):
    """All keys and plain values below a node of JSON."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield key
            yield from values(value)
    elif isinstance(node, list):
        for value in node:
            yield from values(value)
    else:
        yield node


def check(path):
    data = path.read_bytes()
    assert re.match(rb"%PDF-1\.4\n%[\x80-\xff]{4}", data), "header"
    assert b"/ObjStm" not in data and b"/Type /XRef" not in data, "compressed objects"
    assert data.rstrip().endswith(b"%%EOF"), "something behind the end"
    subprocess.run(["qpdf", "--check", path], check=True, stdout=subprocess.DEVNULL)
    text = subprocess.run(["qpdf", "--json=2", "--json-stream-data=inline", "--decode-level=none", path], check=True,
                          capture_output=True, text=True).stdout
    objects = json.loads(text)["qpdf"][1]
    decoded = json.loads(subprocess.run(["qpdf", "--json=2", "--json-stream-data=inline", "--decode-level=all", path],
                                        check=True, capture_output=True, text=True).stdout)["qpdf"][1]

    def of(reference):
        return objects[f"obj:{reference}"]

    def stream(reference):
        return base64.b64decode(decoded[f"obj:{reference}"]["stream"]["data"])

    trailer = objects["trailer"]["value"]
    assert len(trailer["/ID"]) == 2 and len(trailer["/ID"][0]) > 10, "no identifier"
    everything = set(map(str, values(objects)))
    assert not everything & FORBIDDEN, f"has {everything & FORBIDDEN}"
    assert "/LZWDecode" not in everything, "LZW"
    root = of(trailer["/Root"])["value"]

    intent = root["/OutputIntents"][0]
    assert intent["/S"] == "/GTS_PDFA1" and intent["/OutputConditionIdentifier"], "output intent"
    profile = stream(intent["/DestOutputProfile"])
    assert of(intent["/DestOutputProfile"])["stream"]["dict"]["/N"] == 3, "components"
    assert int.from_bytes(profile[0:4], "big") == len(profile) and profile[8] == 2, "profile"
    assert profile[12:20] == b"mntrRGB " and profile[36:40] == b"acsp", "profile"

    metadata = of(root["/Metadata"])["stream"]["dict"]
    assert "/Filter" not in metadata and metadata["/Type"] == "/Metadata" and metadata["/Subtype"] == "/XML", "metadata"
    xmp = stream(root["/Metadata"]).decode("utf-8")
    assert xmp.startswith("<?xpacket begin=") and "encoding=" not in xmp, "packet"
    tree = xml.etree.ElementTree.fromstring(re.sub(r"<\?xpacket[^>]*\?>", "", xmp))
    found = {e.tag: (e.text or "") for e in tree.iter()}
    assert found["{http://www.aiim.org/pdfa/ns/id/}part"] == "1", "part"
    assert found["{http://www.aiim.org/pdfa/ns/id/}conformance"] == "B", "conformance"
    info = of(trailer["/Info"])["value"]
    assert set(info) == {"/Producer"} and info["/Producer"] == "u:" + found["{http://ns.adobe.com/pdf/1.3/}Producer"]

    pages = of(root["/Pages"])["value"]
    assert pages["/Count"] == 1, "pages"
    page = of(pages["/Kids"][0])["value"]
    assert set(page["/Resources"]) <= {"/ProcSet"}, page["/Resources"]
    content = stream(page["/Contents"]).decode("ascii")
    words = content.replace("[", " ").replace("]", " ").split()
    for word in words:
        if re.fullmatch(r"-?\d*\.?\d+", word):
            assert abs(float(word)) <= 32767, f"number {word}"
        else:
            assert word in OPERATORS, f"operator {word}"
    assert words.count("S") + words.count("f") > 5, "hardly any line"


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    for scene, options in (("flange", []), ("cube", ["--style", "pencil"]), ("still_life", ["--paper", "letter"])):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.pdf"
            subprocess.run([program, "render", scenes / f"{scene}.toml", "-o", path, "-q", "--page", "patent", *options],
                           check=True)
            check(path)
            print(f"{scene}: as PDF/A-1b asks")


if __name__ == "__main__":
    main()
