"""The colour and opacity of a material of Blender: one of each, as Burin's surfaces have."""

from typing import NamedTuple

# Shader nodes with one colour, and the name of its socket.
COLOR_SOCKETS = {
    "BSDF_PRINCIPLED": "Base Color", "BSDF_DIFFUSE": "Color", "BSDF_GLOSSY": "Color", "BSDF_TOON": "Color",
    "BSDF_VELVET": "Color", "BSDF_SHEEN": "Color", "BSDF_GLASS": "Color", "BSDF_TRANSLUCENT": "Color",
    "SUBSURFACE_SCATTERING": "Color", "EEVEE_SPECULAR": "Base Color", "EMISSION": "Color",
}


class Look(NamedTuple):
    """What of a material reaches a picture."""
    name: str
    color: tuple
    opacity: float
    pass_index: int


def limited(number):
    return min(max(float(number), 0.0), 1.0)


def output_node(material):
    """The active output, or None."""
    for target in ("ALL", "CYCLES", "EEVEE"):
        output = material.node_tree.get_output_node(target)
        if output is not None:
            return output
    return None


def node_at(output, socket_name):
    """The node that an output's socket is linked to, or None."""
    links = output.inputs[socket_name].links if output is not None else ()
    return links[0].from_node if links else None


def constant(node, socket_name):
    """The value of a socket that nothing computes, or None."""
    socket = node.inputs.get(socket_name)
    return None if socket is None or socket.is_linked else socket.default_value


def look_of(material, notes):
    """The colour of the surface's shader node, or, where nodes compute one or there are none, that of the viewport
    display. Adds to `notes` what was not understood."""
    color, opacity = material.diffuse_color[:3], material.diffuse_color[3]
    if material.use_nodes and material.node_tree is not None:
        output = output_node(material)
        for socket_name in ("Volume", "Displacement"):
            if node_at(output, socket_name) is not None:
                notes.add(f"material {material.name}: Burin leaves its {socket_name.lower()} out")
        node = node_at(output, "Surface")
        name = COLOR_SOCKETS.get(node.type) if node is not None else None
        found = constant(node, name) if name else None
        if found is None:
            if node is None:
                why = "it has no surface"
            else:
                why = f"its colour comes from {'the node' if name is None else 'nodes before'} {node.bl_label}"
            notes.add(f"material {material.name}: {why}; Burin takes the colour of its viewport display")
        else:
            color = found[:3]
            opacity = 1.0
            if "Alpha" in node.inputs:
                alpha = constant(node, "Alpha")
                if alpha is None:
                    notes.add(f"material {material.name}: nodes compute its alpha; Burin draws it opaque")
                else:
                    opacity = alpha
    return Look(material.name, tuple(limited(c) for c in color), limited(opacity), material.pass_index)
