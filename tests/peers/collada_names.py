"""The elements of a COLLADA document, found by name and by id."""

from problem import Problem


class Document:
    def __init__(self, path, root):
        self.path = path
        self.root = root
        self.prefix = root.tag[:root.tag.find("}") + 1]
        self.ids = {element.get("id"): element for element in root.iter() if element.get("id")}

    def problem(self, element, what):
        identity = next((f' {key}="{element.get(key)}"' for key in ("id", "url", "material") if element.get(key)), "")
        return Problem(f"{self.path}: <{self.name(element)}{identity}>: {what}")

    def qualified(self, name):
        return self.prefix + name

    def name(self, element):
        return element.tag[len(self.prefix):] if element.tag.startswith(self.prefix) else element.tag

    def children(self, parent, name):
        return parent.findall(self.qualified(name))

    def optional(self, parent, name):
        return parent.find(self.qualified(name))

    def child(self, parent, name):
        found = self.optional(parent, name)
        if found is None:
            raise self.problem(parent, f"no <{name}> in it")
        return found

    def by_id(self, reference, at):
        found = self.ids.get((reference or "").removeprefix("#"))
        if found is None:
            raise self.problem(at, f"refers to {reference}, which is not there")
        return found

    def target(self, element, attribute="url"):
        return self.by_id(element.get(attribute), element)

    def numbers(self, element, count=None):
        try:
            values = [float(word) for word in (element.text or "").split()]
        except ValueError:
            raise self.problem(element, "not numbers") from None
        if count is not None and len(values) != count:
            raise self.problem(element, f"{count} numbers expected, not {len(values)}")
        return values

    def cmu462(self, owner):
        """The technique of the CMU462 profile in an <extra> of `owner`, or None."""
        for extra in self.children(owner, "extra"):
            for technique in self.children(extra, "technique"):
                if technique.get("profile") == "CMU462" and len(technique):
                    return technique
        return None
