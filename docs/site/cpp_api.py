"""The page of the C++ API: every class by the folder of its header, with the first sentence of its comment or its header, linked to its page by Doxygen."""
import collections
import posixpath
import xml.etree.ElementTree as ElementTree

HEAD = """# C++ API

Headers for plugins and embedding programs: [by file](cpp/files.html), [by class](cpp/annotated.html),
[by function](cpp/namespacetack.html). How a component is written: [extending.md](extending.md). Components outside of the tree, and programs around
the library: [plugins.md](plugins.md).

"""


def text_of(element):
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def first_sentence(text):
    head, dot, _ = text.partition(". ")
    return (head + "." if dot else text).replace("|", "\\|").replace("<", "&lt;").replace("$", "&#36;").replace("*", "\\*").replace("_", "\\_").replace("[", "\\[")


def brief_of(definition):
    return first_sentence(text_of(definition.find("briefdescription")) or text_of(definition.find("detaileddescription")))


def page(xml):
    """Returns the page, from the XML of Doxygen."""
    folders, files = collections.defaultdict(list), {}
    for compound in ElementTree.parse(xml / "index.xml").getroot().iter("compound"):
        if compound.get("kind") == "file":
            definition = ElementTree.parse(xml / f"{compound.get('refid')}.xml").getroot().find("compounddef")
            files[definition.find("location").get("file")] = brief_of(definition)
        if compound.get("kind") not in ("class", "struct"):
            continue
        name, ref = compound.findtext("name"), compound.get("refid")
        if name.count("::") != 1 or not name.startswith("tack::"):
            continue
        definition = ElementTree.parse(xml / f"{ref}.xml").getroot().find("compounddef")
        header = definition.find("location").get("file")
        folders[posixpath.dirname(header)].append((name[len("tack::"):], ref, posixpath.basename(header), brief_of(definition)))
    out = [HEAD]
    for folder in sorted(folders):
        out.append(f"## {folder}\n\n| class | its comment |\n| --- | --- |\n")
        for name, ref, header, brief in sorted(folders[folder]):
            brief = brief or f"`{header}`: {files.get(f'{folder}/{header}', '')}"
            out.append(f"| [`{name}`](cpp/{ref}.html) | {brief} |\n")
        out.append("\n")
    return "".join(out)
