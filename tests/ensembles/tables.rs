//! What leaves the program: columns, archives of NumPy, JSON.

use std::io::{Cursor, Read};
use std::path::Path;

use affine_runtime::model::Conserved;
use affine_runtime::nalgebra;
use affine_runtime::prelude::*;
use affine_runtime::simulate::{Format, Reason, Table};
use bytes::Bytes;
use npyz::NpyFile;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::models::{Blown, DrunkMissile, Elastic, Sampled, Unprotected, Wind, vibrating};

/// Point, energy, work, what is conserved and its drift, each where it belongs.
#[test]
fn a_table_has_energies_drifts_and_what_is_conserved() {
    let run =
        Simulation::new(&DrunkMissile, DrunkMissile.samples(1, 71)[0]).until(2.0).every(0.5).run().unwrap();
    let table = run.table();
    let column = |name: &str| table.column(name).unwrap_or_else(|| panic!("{name} of {:?}", table.names()));
    assert_eq!((table.len(), column("t")), (5, run.times()));
    assert_eq!(column("energy"), run.energies());
    let (_, start) = run.start();
    for (k, (_, point)) in run.iter().enumerate() {
        assert_eq!((column("x2")[k], column("phi13")[k]), (point.x()[1], point.phi()[(0, 2)]));
        assert_eq!(
            (column("p1")[k], column("Sigma_hat32")[k]),
            (point.p()[0], point.sigma_hat().0.0[(2, 1)])
        );
        let trace = (point.sigma().0.0 * point.sigma().0.0).trace();
        if let Some(values) = table.column("second_Casimir") {
            assert!((values[k] - trace).abs() < 1e-12);
        }
        assert_eq!(column("linear_momentum3")[k], point.p()[2]);
        assert_eq!(column("drift_linear_momentum")[k], (point.p() - start.p()).norm());
    }
    // The largest entries of the columns are the rows of the table of drifts.
    for drift in run.conservation().drifts() {
        let name = format!("drift_{}", drift.quantity.name().replace([' ', '-'], "_"));
        let largest = column(&name).iter().fold(0.0, |most: f64, value| most.max(*value));
        assert_eq!(largest, drift.absolute, "{name}");
    }
    assert!(run.conservation().of(Conserved::Energy).is_some());
    assert!(table.column("work").is_none());

    let blown = Blown { eta: Matrix::<2>::identity(), j: 1.0, s: 0.5, wind: Wind(0.3) }.prepare().unwrap();
    let (zero, one) = (Vector::<2>::zeros(), Matrix::<2>::identity());
    let start = blown.at_velocity(zero, one, zero, Matrix::<2>::zeros()).unwrap();
    let table = Simulation::new(&blown, start).until(1.0).every(0.25).run().unwrap().table();
    // At rest at first: what the centre gains is the work of the wind, w x.
    for (work, x) in table.column("work").unwrap().iter().zip(table.column("x1").unwrap()) {
        assert!((work - 0.3 * x).abs() < 1e-9, "{work} {x}");
    }
}

/// To the bit, by the names that CSV has; and the same bytes for the same numbers.
#[test]
fn archives_read_back_as_the_same_numbers() {
    let run = Simulation::new(&Elastic, Elastic.samples(1, 72)[0]).until(1.0).every(0.1).run().unwrap();
    let table = run.table();
    let bytes = || {
        let mut bytes = Cursor::new(Vec::new());
        table.npz(&mut bytes).unwrap();
        bytes.into_inner()
    };
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes())).unwrap();
    assert_eq!(archive.len(), table.names().len());
    for (name, column) in table.columns() {
        let mut array = Vec::new();
        archive
            .by_name(&npyz::npz::file_name_from_array_name(name))
            .unwrap()
            .read_to_end(&mut array)
            .unwrap();
        let read = NpyFile::new(array.as_slice()).unwrap().into_vec::<f64>().unwrap();
        assert_eq!(read, column, "{name}");
    }
    assert_eq!(bytes(), bytes());
    let mut text = Vec::new();
    run.csv(&mut text).unwrap();
    let first = String::from_utf8(text).unwrap().lines().next().unwrap().to_owned();
    assert_eq!(first, table.names().join(","));
}

/// To the bit, with what is known of the run.
#[test]
fn parquet_reads_back_as_the_same_numbers() {
    let run = Simulation::new(&Elastic, Elastic.samples(1, 72)[0]).until(1.0).every(0.1).run().unwrap();
    let mut table = run.table();
    table.note("seed", 71);
    table.note("seed", 72);
    let eta = Matrix::<2>::new(1.3, 0.2, 0.2, 0.9);
    table.note_fields(&Blown { eta, j: 1.0, s: 0.5, wind: Wind(0.3) });
    let bytes = || {
        let mut bytes = Vec::new();
        table.parquet(&mut bytes).unwrap();
        bytes
    };
    assert_eq!(bytes(), bytes());
    let file = SerializedFileReader::new(Bytes::from(bytes())).unwrap();
    let about = file.metadata().file_metadata().key_value_metadata().unwrap();
    let about: Vec<_> = about.iter().map(|word| (word.key.clone(), word.value.clone().unwrap())).collect();
    assert_eq!(about, table.about());
    let said = |key: &str| about.iter().find(|(own, _)| own == key).map(|(_, text)| text.as_str());
    assert_eq!((said("model"), said("seed")), (Some("Elastic"), Some("72")));
    assert_eq!(said("hamiltonian"), Some(Elastic::DESCRIPTION.hamiltonian.text));
    assert_eq!(
        ["field_j", "field_s", "field_eta11", "field_eta21"].map(said),
        ["1", "0.5", "1.3", "0.2"].map(Some)
    );
    assert_eq!(said("tolerance"), Some(format!("{}", run.computation().tolerance).as_str()));
    assert_eq!(said("method"), Some(format!("{:?}", run.computation().method).as_str()));
    let mut read = vec![Vec::new(); table.names().len()];
    for row in file.get_row_iter(None).unwrap() {
        for (k, (name, value)) in row.unwrap().get_column_iter().enumerate() {
            assert_eq!(name, &table.names()[k]);
            let Field::Double(value) = value else { panic!("{name} is {value}") };
            read[k].push(value.to_bits());
        }
    }
    for ((name, column), read) in table.columns().zip(read) {
        assert_eq!(column.iter().map(|value| value.to_bits()).collect::<Vec<_>>(), read, "{name}");
    }
}

/// Names alone.
#[test]
fn a_table_without_rows_is_written_as_well() {
    let mut bytes = Vec::new();
    let table = Table::of_bodies::<2, Unprotected>(&["a"]).unwrap();
    table.parquet(&mut bytes).unwrap();
    let file = SerializedFileReader::new(Bytes::from(bytes)).unwrap();
    let schema = file.metadata().file_metadata().schema_descr();
    let names: Vec<_> = schema.columns().iter().map(|column| column.name()).collect();
    assert_eq!(
        (names, file.metadata().file_metadata().num_rows()),
        (table.names().iter().map(String::as_str).collect(), 0)
    );
}

/// Files and programs ask for a column by its name.
#[test]
fn a_name_that_two_columns_would_have_is_refused() {
    for (names, repeated) in [
        (&["a", "b", "a"][..], "a"),
        (&["body"], "body"),
        (&["t"], "t"),
        (&["x1"], "x1"),
        (&["phi22"], "phi22"),
        (&["Pi12", "c"], "Pi12"),
    ] {
        let error = Table::of_bodies::<2, Unprotected>(names).unwrap_err();
        let affine_runtime::Error::RepeatedColumn { name } = &error else { panic!("{error}") };
        assert_eq!(name, repeated);
        assert!(error.to_string().contains(&format!("`{repeated}`")), "{error}");
        let folder = std::env::temp_dir().join(format!("affine-repeated-{}", std::process::id()));
        let starts = Unprotected.samples(1, 76);
        let save =
            Ensemble::new(&Unprotected, starts)
                .until(0.1)
                .save(&folder, (Format::Csv, 8), names, |_| Vec::new());
        assert_eq!(save.unwrap_err(), error);
        assert!(!folder.exists(), "refused before anything is computed or written");
    }
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let path = Path::new("no such folder/table.parquet");
    let table = Table::of_bodies::<2, Unprotected>(&[]).unwrap();
    for format in [Format::Csv, Format::Npz, Format::Parquet] {
        let error = table.save(path, format).unwrap_err();
        let affine_runtime::Error::File { path: named, kind } = error else { panic!("{error}") };
        assert_eq!((named.as_path(), kind), (path, std::io::ErrorKind::NotFound));
    }
}

fn comes_back<V: Serialize + DeserializeOwned + PartialEq + std::fmt::Debug>(value: &V) {
    let text = serde_json::to_string(value).unwrap();
    assert_eq!(&serde_json::from_str::<V>(&text).unwrap(), value, "{text}");
}

#[test]
fn points_and_tables_come_back_from_text_to_the_bit() {
    DrunkMissile.samples(5, 73).iter().for_each(comes_back);
    vibrating().samples(5, 73).iter().for_each(comes_back);
    Elastic.samples(5, 73).iter().for_each(comes_back);
    Unprotected.samples(5, 73).iter().for_each(comes_back);
    let run = Simulation::new(&Unprotected, Unprotected.samples(1, 74)[0]).until(0.5).run().unwrap();
    comes_back(&run.table());
    let numbers: Vec<f64> = serde_json::from_str(&serde_json::to_string(run.end().1).unwrap()).unwrap();
    let (phi, pi) = (run.end().1.phi(), run.end().1.pi().0.0);
    assert_eq!(numbers[..4], [phi[(0, 0)], phi[(0, 1)], phi[(1, 0)], phi[(1, 1)]], "row by row");
    assert_eq!((numbers[5], numbers.len()), (pi[(0, 1)], 12));
}

type Planar = <Unprotected as Model<2>>::Point<f64>;

#[test]
fn what_is_no_point_is_refused() {
    let read = |text: &str| serde_json::from_str::<Planar>(text).unwrap_err().to_string();
    assert!(read("[1,0,0,1, 0,0,0]").contains("invalid length 7, expected the 12 numbers"));
    assert!(read("[1,0,0,1, 0,0,0,0, 0,0,0,1e999]").contains("out of range"));
}

/// What a run may come to is read; a run that begins there ends at once.
#[test]
fn a_point_turned_inside_out_is_refused_by_runs() {
    let read: Planar = serde_json::from_str("[1,0,0,-1, 0,0,0,0, 0,0,0,0]").unwrap();
    let reason = Simulation::new(&Unprotected, read).until(0.1).run().unwrap_err().stop.reason;
    assert!(matches!(reason, Reason::Placement { determinant: -1.0, .. }), "{reason}");
}

/// A notebook or a page reads a run, a stop and a model.
#[test]
fn runs_stops_and_descriptions_are_written() {
    let start = Unprotected.samples(1, 75)[0];
    let run = Simulation::new(&Unprotected, start).until(0.5).every(0.25).run().unwrap();
    let value = serde_json::to_value(&run).unwrap();
    assert_eq!(value["times"].as_array().unwrap().len(), 3);
    assert_eq!(value["points"][2][0].as_f64().unwrap(), run.end().1.phi()[(0, 0)]);
    assert_eq!(value["description"]["name"], "Unprotected");
    assert_eq!(
        value["description"]["hamiltonian"]["latex"].as_str(),
        Unprotected::DESCRIPTION.hamiltonian.latex
    );
    let drifts = serde_json::to_value(run.conservation()).unwrap();
    assert_eq!(drifts["drifts"][0]["quantity"], "Energy");
    let halt = Simulation::new(&Unprotected, start).until(0.5).max_steps(1).run().unwrap_err();
    let value = serde_json::to_value(&halt).unwrap();
    assert_eq!(value["stop"]["reason"], halt.stop.reason.to_string());
    assert_eq!(value["stop"]["steps"], 1);
    let mut written = Vec::new();
    Ensemble::new(&Unprotected, [start])
        .until(0.1)
        .each(|body| written.push(serde_json::to_value(body).unwrap()))
        .unwrap();
    assert_eq!(written[0]["number"], 0);
    assert!(written[0]["end"]["Ok"].is_array());
}

#[test]
fn a_table_of_bodies_has_what_it_is_given() {
    let mut table = Table::of_bodies::<2, Unprotected>(&["a", "b"]).unwrap();
    let point = Unprotected.samples(1, 76)[0];
    table.push::<2, Unprotected>(7, &[0.5, 2.0], 1.5, &point);
    table.push::<2, Unprotected>(8, &[0.25], 2.5, &point);
    assert_eq!(table.names()[..6], ["body", "a", "b", "t", "x1", "x2"]);
    assert_eq!(table.column("body").unwrap(), [7.0, 8.0]);
    assert_eq!(table.column("t").unwrap(), [1.5, 2.5]);
    assert!(table.column("b").unwrap()[1].is_nan());
    assert_eq!(table.column("phi21").unwrap()[0], point.phi()[(1, 0)]);
}

#[test]
fn points_are_transformations_of_nalgebra() {
    let point = DrunkMissile.samples(1, 77)[0];
    let a = nalgebra::Point3::new(0.3, -0.2, 0.7);
    let moved = nalgebra::Affine3::from(&point) * a;
    assert!((moved.coords - (point.x() + point.phi() * a.coords)).norm() < 1e-15);
    // Of a rigid body the placement is a rotation; of a stretch along the axes of the body the rotation is what is left.
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.4, 0.5);
    let stretch = Matrix::<3>::from_diagonal(&Vector::<3>::new(1.2, 0.9, 1.1));
    let x = Vector::<3>::new(1.0, 2.0, 3.0);
    let zero = Comoving(Matrix::<3>::zeros());
    let stretched = DrunkMissile.at_momentum(x, turn.matrix() * stretch, x, zero).unwrap();
    let isometry = nalgebra::Isometry3::from(&stretched);
    assert!((isometry.rotation.to_rotation_matrix().matrix() - turn.matrix()).norm() < 1e-14);
    assert_eq!(isometry.translation.vector, x);
    let planar = Unprotected.samples(1, 77)[0];
    let a = nalgebra::Point2::new(0.3, -0.2);
    let moved = nalgebra::Affine2::from(&planar) * a;
    assert!((moved.coords - (planar.x() + planar.phi() * a.coords)).norm() < 1e-15);
    assert_eq!(nalgebra::Isometry2::from(&planar).translation.vector, planar.x());
}

#[test]
fn points_are_compared_number_by_number() {
    let point = Unprotected.samples(1, 78)[0];
    let off = |place: usize, by: f64| {
        let mut numbers = Unprotected.flatten(&point);
        numbers[place] += by;
        Unprotected.unflatten(&numbers)
    };
    approx::assert_relative_eq!(point, point);
    for place in 0..12 {
        approx::assert_abs_diff_eq!(point, off(place, 1e-9), epsilon = 1e-8);
        approx::assert_abs_diff_ne!(point, off(place, 1e-7), epsilon = 1e-8);
        approx::assert_relative_ne!(point, off(place, 1e-7));
        approx::assert_ulps_ne!(point, off(place, 1e-7));
    }
}
