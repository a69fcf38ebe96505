"""flush_lights with its lamp and lights moved away from the panel that they lie in."""

# In scenes/flush_lights.dae, in the coordinates of the panel: the lamp, the light beside it, the light on it; and how many
# times the distance each is moved.
MOVED = (("<translate>-0.1 0.025 0</translate>", 1), ("<translate>-1 0.3 0</translate>", 1),
         ("<translate>0.1 0.05 0</translate>", 2))


def lifted(text, distance):
    """The scene's text, with lights at this distance in front of what they lay on."""
    for node, times in MOVED:
        if text.count(node) != 1:
            raise ValueError(f"flush_lights.dae: not exactly one {node}")
        text = text.replace(node, node.replace(" 0<", f" {times * distance}<"))
    return text
