//! A document of glTF with its numbers.

use std::io;

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::animation::{Channel, Interpolation, Property, Sampler, Target as ChannelTarget};
use gltf_json::buffer::{Target, View};
use gltf_json::material::{PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mode, MorphTarget, Primitive, Semantic};
use gltf_json::scene::UnitQuaternion;
use gltf_json::validation::Checked::Valid;
use gltf_json::{
    Accessor, Animation, Asset, Buffer, Extras, Index, Material, Mesh, Node, Root, Scene, Value,
};

use super::Shape;

pub(super) type Numbers = Index<Accessor>;
pub(super) type Part = Index<Node>;

/// Of even and odd octants, and of the end of the first axis: red, green, blue, linear.
const COLOURS: [[f32; 3]; 3] = [[0.0, 0.17, 0.45], [0.17, 0.54, 0.87], [0.79, 0.17, 0.0]];

pub(super) struct Document {
    root: Root,
    bytes: Vec<u8>,
    /// Every number so far is one in single precision.
    is_finite: bool,
}

/// An animation being made: its keyframes, and what moves.
pub(super) struct Clip {
    times: Numbers,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

impl Clip {
    pub(super) fn new(times: Numbers) -> Self {
        Self { times, channels: Vec::new(), samplers: Vec::new() }
    }
}

impl Document {
    pub(super) fn new(name: &str) -> Self {
        let generator = Some(concat!("affine-runtime ", env!("CARGO_PKG_VERSION")).to_owned());
        let asset = Asset { generator, ..Asset::default() };
        let scene = Scene {
            name: Some(name.to_owned()),
            nodes: Vec::new(),
            extensions: None,
            extras: Extras::default(),
        };
        let root = Root { asset, scenes: vec![scene], scene: Some(Index::new(0)), ..Root::default() };
        Self { root, bytes: Vec::new(), is_finite: true }
    }

    /// Numbers in single precision.
    pub(super) fn floats(
        &mut self,
        kind: Type,
        values: impl Iterator<Item = f64>,
        target: Option<Target>,
    ) -> Numbers {
        let values: Vec<f32> = values.map(|value| value as f32).collect();
        self.is_finite &= values.iter().all(|value| value.is_finite());
        let each = kind.multiplicity();
        let bound = |better: fn(f32, f32) -> f32| {
            let of = |k: usize| values.iter().skip(k).step_by(each).copied().reduce(better);
            Some(Value::from((0..each).filter_map(of).collect::<Vec<f32>>()))
        };
        let (min, max) = (bound(f32::min), bound(f32::max));
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let accessor = self.accessor((ComponentType::F32, kind), values.len() / each, bytes, target);
        self.root.push(Accessor { min, max, ..accessor })
    }

    /// Points of a mesh, or vectors at them.
    pub(super) fn points(&mut self, points: impl Iterator<Item = [f64; 3]>) -> Numbers {
        self.floats(Type::Vec3, points.flatten(), Some(Target::ArrayBuffer))
    }

    fn accessor(
        &mut self,
        (component, kind): (ComponentType, Type),
        count: usize,
        bytes: Vec<u8>,
        target: Option<Target>,
    ) -> Accessor {
        let view = View {
            buffer: Index::new(0),
            byte_length: bytes.len().into(),
            byte_offset: Some(self.bytes.len().into()),
            byte_stride: None,
            name: None,
            target: target.map(Valid),
            extensions: None,
            extras: Extras::default(),
        };
        self.bytes.extend(bytes);
        Accessor {
            buffer_view: Some(self.root.push(view)),
            byte_offset: None,
            count: count.into(),
            component_type: Valid(GenericComponentType(component)),
            type_: Valid(kind),
            min: None,
            max: None,
            name: None,
            normalized: false,
            sparse: None,
            extensions: None,
            extras: Extras::default(),
        }
    }

    /// The triangles of a shape, a part for each of its colours; points where it has none.
    pub(super) fn mesh<const N: usize>(
        &mut self,
        shape: &Shape<N>,
        attributes: &[(Semantic, Option<Numbers>)],
        targets: Option<Vec<MorphTarget>>,
    ) -> Index<Mesh> {
        let given =
            attributes.iter().filter_map(|(semantic, numbers)| Some((Valid(semantic.clone()), (*numbers)?)));
        let bare = Primitive {
            attributes: given.collect(),
            indices: None,
            material: None,
            mode: Valid(Mode::Points),
            targets: targets.clone(),
            extensions: None,
            extras: Extras::default(),
        };
        let mut primitives = Vec::new();
        for (triangles, colour) in shape.triangles().iter().zip(COLOURS).filter(|(list, _)| !list.is_empty())
        {
            let bytes = triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
            let kind = (ComponentType::U32, Type::Scalar);
            let corners = self.accessor(kind, 3 * triangles.len(), bytes, Some(Target::ElementArrayBuffer));
            let (indices, material) = (Some(self.root.push(corners)), Some(self.root.push(matt(colour))));
            primitives.push(Primitive { indices, material, mode: Valid(Mode::Triangles), ..bare.clone() });
        }
        if primitives.is_empty() {
            primitives.push(bare);
        }
        let weights = targets.map(|targets| vec![0.0; targets.len()]);
        self.root.push(Mesh { primitives, weights, name: None, extensions: None, extras: Extras::default() })
    }

    pub(super) fn node(&mut self, name: &str, child: Option<Part>, mesh: Option<Index<Mesh>>) -> Part {
        let children = child.map(|child| vec![child]);
        self.root.push(Node { name: Some(name.to_owned()), children, mesh, ..Node::default() })
    }

    /// Lets a property of a node have these values at the keyframes.
    pub(super) fn animate(
        &mut self,
        clip: &mut Clip,
        node: Part,
        property: Property,
        kind: Type,
        values: impl Iterator<Item = f64>,
    ) {
        let output = self.floats(kind, values, None);
        let (extensions, extras) = (None, Extras::default());
        let interpolation = Valid(Interpolation::Linear);
        let sampler = Index::push(
            &mut clip.samplers,
            Sampler { input: clip.times, interpolation, output, extensions, extras },
        );
        let target =
            ChannelTarget { node, path: Valid(property), extensions: None, extras: Extras::default() };
        clip.channels.push(Channel { sampler, target, extensions: None, extras: Extras::default() });
    }

    /// The file: a scene with this node, turned where the third axis is to point upward, which is the second one of glTF.
    pub(super) fn finish(mut self, clip: Clip, inner: Part, is_turned: bool) -> io::Result<Vec<u8>> {
        if !self.is_finite {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "numbers beyond single precision"));
        }
        let space = self.node("space", Some(inner), None);
        let half = core::f32::consts::FRAC_1_SQRT_2;
        self.root.nodes[space.value()].rotation =
            is_turned.then_some(UnitQuaternion([-half, 0.0, 0.0, half]));
        self.root.scenes[0].nodes.push(space);
        let Clip { channels, samplers, .. } = clip;
        self.root.push(Animation {
            channels,
            samplers,
            name: Some("motion".to_owned()),
            extensions: None,
            extras: Extras::default(),
        });
        let byte_length = self.bytes.len().into();
        self.root.push(Buffer {
            byte_length,
            name: None,
            uri: None,
            extensions: None,
            extras: Extras::default(),
        });
        let json = gltf_json::serialize::to_vec(&self.root)?;
        container([(*b"JSON", json, b' '), (*b"BIN\0", self.bytes, 0)])
    }
}

/// The container of binary glTF 2.0: chunks of whole words, each behind its length and kind.
fn container(chunks: [([u8; 4], Vec<u8>, u8); 2]) -> io::Result<Vec<u8>> {
    let word = |length: usize| {
        let word =
            u32::try_from(length).map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "more than 4 GiB"));
        word.map(u32::to_le_bytes)
    };
    let mut file = Vec::new();
    for (kind, mut chunk, filling) in chunks {
        chunk.resize(chunk.len().next_multiple_of(4), filling);
        file.extend(word(chunk.len())?.into_iter().chain(kind).chain(chunk));
    }
    let head = [*b"glTF", 2u32.to_le_bytes(), word(12 + file.len())?];
    Ok(head.into_iter().flatten().chain(file).collect())
}

fn matt([red, green, blue]: [f32; 3]) -> Material {
    let pbr_metallic_roughness = PbrMetallicRoughness {
        base_color_factor: PbrBaseColorFactor([red, green, blue, 1.0]),
        metallic_factor: StrengthFactor(0.0),
        roughness_factor: StrengthFactor(0.6),
        ..PbrMetallicRoughness::default()
    };
    Material { pbr_metallic_roughness, double_sided: true, ..Material::default() }
}
