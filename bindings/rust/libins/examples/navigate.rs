use libins::{attitude::Attitude, coning::Form, quat, rates::Rates, Error};

fn main() -> Result<(), Error> {
    let mut rates = Rates::new(4, 0.02)?; // Adams-Moulton, order 4, 20 ms
    let mut attitude = Attitude::new(Form::Hist2Opt, &[1.0, 0.0, 0.0, 0.0])?;
    for _ in 0..500 {
        let (dtheta_b, _) = rates.add(&[0.0, 0.0, 0.2])?; // your gyro, rad/s
        attitude.step(&dtheta_b)?;
    }
    println!("heading {:.3} rad", quat::to_euler(attitude.q_nb())[2]);
    Ok(())
}
