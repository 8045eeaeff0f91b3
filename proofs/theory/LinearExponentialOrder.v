(** * A linear exponential per segment costs all orders but one

    Claim.  Let C = tau = 1, so that the optical depth of a segment is its length
    d = D/n, the transmittance exp(-D) and the radiance 1 - exp(-D).  With 1 - d for
    the attenuation of a segment, exact otherwise,

    - the transmittance (1 - d)^n has no order above 1,
    - nor has the radiance by the outer trapezoid rule, which is itself of order 2.

    Here "order r" means that a K exists with an error of at most K d^r for all n.

    Source.  The counterpart of LinearExponential.v, by an example.

    Assumptions.  D > 0.

    It is why the program limits the order it expects to 1 wherever an exponential is
    linear, however good the rules are. *)

From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Cases Sums Derivatives Quadrature Order Nested NestedRules
  LinearExponential.
Import ListNotations.
Open Scope R_scope.

(** An error of at least [k] d from some n on excludes every order above 1. *)
Lemma order_at_most_one (r : nat) (D exact k k' : R) (approximation : nat -> R) :
  0 < D -> 0 < k ->
  (forall n, (0 < n)%nat -> D / INR n <= 1 ->
     k * (D / INR n) - k' * (D / INR n) ^ 2 <= Rabs (exact - approximation n)) ->
  has_order r D exact approximation -> (r <= 1)%nat.
Proof.
  intros HD Hk error [K HK]. destruct (le_lt_dec r 1) as [| Hr]; [easy | exfalso].
  set (B := Rabs K * D ^ (r - 2) + Rabs k').
  assert (B_pos : 0 <= B).
  { apply Rplus_le_le_0_compat; [apply Rmult_le_pos; [| apply pow_le; lra] |]; apply Rabs_pos. }
  (* so many segments that d <= 1 and B d < k *)
  destruct (nfloor_ex (D + B * D / k)) as [n [_ Hn]].
  { apply Rplus_le_le_0_compat; [lra | apply Rdiv_le_0_compat; [apply Rmult_le_pos |]; lra]. }
  rewrite <- S_INR in Hn. set (N := S n) in *.
  assert (HN : (0 < N)%nat) by (unfold N; lia).
  assert (0 <= B * D / k) by (apply Rdiv_le_0_compat; [apply Rmult_le_pos |]; lra).
  assert (Hd := segment_length D N HD HN).
  assert (length : D = INR N * (D / INR N)) by (field; lra).
  specialize (error N HN). specialize (HK N HN). set (d := D / INR N) in *.
  assert (short : d <= 1) by (unfold d; apply Rle_div_l; lra).
  assert (small : B * d < k).
  { apply Rmult_lt_reg_r with (INR N); [lra |].
    replace (B * d * INR N) with (B * D / k * k) by (rewrite length; field; lra).
    rewrite (Rmult_comm k). apply Rmult_lt_compat_r; lra. }
  assert (upper : K * d ^ r <= Rabs K * D ^ (r - 2) * d ^ 2).
  { rewrite Rmult_assoc. apply Rle_trans with (Rabs K * d ^ r).
    - apply Rmult_le_compat_r; [apply pow_le; lra | apply Rle_abs].
    - apply Rmult_le_compat_l; [apply Rabs_pos | now apply lower_power]. }
  assert (k' * d ^ 2 <= Rabs k' * d ^ 2)
    by (apply Rmult_le_compat_r; [apply pow2_ge_0 | apply Rle_abs]).
  assert (k * d <= B * d ^ 2) by (specialize (error short); unfold B; lra).
  assert (B * d * d < k * d) by (apply Rmult_lt_compat_r; lra).
  replace (d ^ 2) with (d * d) in * by ring. lra.
Qed.

(** (1 - d) exp d lies between 1 - d^2/2 - d^3/2 and 1 - d^2/2. *)
Lemma one_segment_above (d : R) : 0 <= d -> (1 - d) * exp d <= 1 - d ^ 2 / 2.
Proof.
  intros Hd.
  assert (H := nondecreasing (fun x => - (x ^ 2 / 2) - (1 - x) * exp x)
    (fun x => x * (exp x - 1)) d Hd).
  cbv beta in H. rewrite exp_0 in H. cut (- (0 ^ 2 / 2) - (1 - 0) * 1
    <= - (d ^ 2 / 2) - (1 - d) * exp d); [lra |]. apply H; intros x Hx.
  - auto_derive; [easy | field].
  - assert (1 + x <= exp x) by apply exp_ineq1_le. apply Rmult_le_pos; lra.
Qed.

Lemma one_segment_below (d : R) : 0 <= d <= 1 -> 1 - d ^ 2 / 2 - d ^ 3 / 2 <= (1 - d) * exp d.
Proof.
  intros Hd.
  assert (H := nondecreasing (fun x => exp x - (x + x ^ 2 / 2)) (fun x => exp x - (1 + x)) d).
  cbv beta in H. rewrite exp_0 in H.
  assert (quadratic : 1 + d + d ^ 2 / 2 <= exp d).
  { cut (1 - (0 + 0 ^ 2 / 2) <= exp d - (d + d ^ 2 / 2)); [lra |].
    apply H; [lra | |]; intros x Hx.
    - auto_derive; [easy | field].
    - assert (1 + x <= exp x) by apply exp_ineq1_le. lra. }
  replace (1 - d ^ 2 / 2 - d ^ 3 / 2) with ((1 - d) * (1 + d + d ^ 2 / 2)) by field.
  apply Rmult_le_compat_l; lra.
Qed.

Lemma bernoulli (n : nat) (x : R) : 0 <= x <= 1 -> 1 - INR n * x <= (1 - x) ^ n.
Proof.
  intros Hx. induction n as [| n IH]; [simpl; lra |].
  rewrite S_INR. simpl pow. apply Rle_trans with ((1 - x) * (1 - INR n * x)).
  - assert (0 <= INR n * x * x) by (repeat apply Rmult_le_pos; (apply pos_INR || lra)). lra.
  - apply Rmult_le_compat_l; lra.
Qed.

Lemma exp_pow (x : R) (n : nat) : exp x ^ n = exp (INR n * x).
Proof.
  induction n as [| n IH]; [simpl; now rewrite Rmult_0_l, exp_0 |].
  simpl pow. rewrite IH, <- exp_plus, S_INR. f_equal. ring.
Qed.

Section Witness.
Variables (D d : R) (n : nat).
Hypotheses (length : INR n * d = D) (short : 0 < d <= 1).

Lemma power_of_segments : (1 - d) ^ n = exp (- D) * ((1 - d) * exp d) ^ n.
Proof.
  rewrite Rpow_mult_distr, exp_pow, length, (Rmult_comm ((1 - d) ^ n)), <- Rmult_assoc, <- exp_plus.
  replace (- D + D) with 0 by ring. rewrite exp_0. ring.
Qed.

Lemma transmittance_above : (1 - d) ^ n <= exp (- D) * (1 - D / 2 * d + D ^ 2 / 8 * d ^ 2).
Proof.
  rewrite power_of_segments. apply Rmult_le_compat_l; [left; apply exp_pos |].
  apply Rle_trans with (exp (- (d ^ 2 / 2)) ^ n).
  - apply pow_incr. split.
    + apply Rmult_le_pos; [lra | left; apply exp_pos].
    + assert (1 + - (d ^ 2 / 2) <= exp (- (d ^ 2 / 2))) by apply exp_ineq1_le.
      assert (above := one_segment_above d). lra.
  - rewrite exp_pow. replace (INR n * - (d ^ 2 / 2)) with (- (D / 2 * d))
      by (rewrite <- length; field).
    assert (D_pos : 0 <= D) by (rewrite <- length; apply Rmult_le_pos; [apply pos_INR | lra]).
    assert (small : 0 <= D / 2 * d) by (apply Rmult_le_pos; lra).
    destruct (linear_exponential_one _ small). lra.
Qed.

Lemma transmittance_below : exp (- D) * (1 - D / 2 * d - D / 2 * d ^ 2) <= (1 - d) ^ n.
Proof.
  rewrite power_of_segments. apply Rmult_le_compat_l; [left; apply exp_pos |].
  assert (square : 0 <= d ^ 2 <= 1) by (simpl; split; nra).
  assert (cube : 0 <= d ^ 3 <= 1) by (split; [apply pow_le; lra | simpl in *; nra]).
  apply Rle_trans with ((1 - (d ^ 2 / 2 + d ^ 3 / 2)) ^ n).
  - eapply Rle_trans; [| apply bernoulli; lra]. rewrite <- length. apply Req_le. field.
  - apply pow_incr. split; [lra |].
    eapply Rle_trans; [| apply one_segment_below; lra]. lra.
Qed.
End Witness.

Section Order.
Variables (D : R) (r : nat).
Hypothesis some_length : 0 < D.

Lemma segments_make_up (n : nat) : (0 < n)%nat -> INR n * (D / INR n) = D.
Proof. intros Hn. field. now apply not_0_INR, Nat.neq_0_lt_0. Qed.

(** The transmittance of n segments of depth d. *)
Theorem linear_transmittance_order_at_most_one :
  has_order r D (exp (- D)) (fun n => linear_transmittance (repeat (D / INR n) n)) -> (r <= 1)%nat.
Proof.
  apply order_at_most_one with (exp (- D) * (D / 2)) (exp (- D) * (D ^ 2 / 8)); [easy | |].
  - apply Rmult_lt_0_compat; [apply exp_pos | lra].
  - intros n Hn short. assert (Hd := segment_length D n some_length Hn).
    assert (above := transmittance_above D (D / INR n) n (segments_make_up n Hn) ltac:(lra)).
    replace (linear_transmittance (repeat (D / INR n) n)) with ((1 - D / INR n) ^ n).
    + eapply Rle_trans; [| apply Rle_abs]. lra.
    + clear. generalize (D / INR n). intros d. induction n as [| n IH]; [easy |].
      simpl. now rewrite IH.
Qed.

(** C = tau = 1: any field, and the slab of Cases.v. *)
Variable field : R -> R.
Let one := HomogeneousSlab.extinction 1.

Lemma trapezoid_of_one (a h : R) : apply_rule trapezoid (extinction_along field one) a h = h.
Proof. unfold apply_rule, extinction_along, one, HomogeneousSlab.extinction. simpl. field. Qed.

Lemma transmittance_of_one (d x : R) (j : nat) :
  linear_transmittance (segment_depths trapezoid (extinction_along field one) d j x)
  = (1 - d) ^ j * (1 - x).
Proof.
  unfold segment_depths. rewrite trapezoid_of_one.
  rewrite (map_ext _ (fun _ => d)) by (intros i; apply trapezoid_of_one).
  generalize 0%nat. induction j as [| j IH]; intros k; simpl; [ring |].
  unfold linear_transmittance in IH. rewrite IH. ring.
Qed.

Lemma linear_rule_of_one (n : nat) :
  let d := D / INR n in
  linear_rule field one one trapezoid 1 trapezoid_segment D n = (1 - d / 2) * (1 - (1 - d) ^ n).
Proof.
  intros d. unfold linear_rule, ray_nodes, ray_node. rewrite Nat.mul_1_l. fold d.
  rewrite sum_over_pairs.
  rewrite sum_over_ext with (g := fun k => d * (1 - d / 2) * (1 - d) ^ k).
  - rewrite sum_over_scal.
    assert (geometric : forall k, d * sum_over (seq 0 k) (pow (1 - d)) = 1 - (1 - d) ^ k).
    { induction k as [| k IH]; [simpl; ring |].
      rewrite sum_over_seq_S, Rmult_plus_distr_l, IH. simpl. ring. }
    rewrite <- geometric. unfold pow. ring.
  - intros k _. unfold trapezoid_segment. simpl sum_over. rewrite !transmittance_of_one.
    unfold source, one, HomogeneousSlab.extinction. simpl. rewrite Nat.mul_1_r, Nat.add_0_r. field.
Qed.

Theorem linear_exponential_order_at_most_one :
  has_order r D (radiance field one one D)
    (linear_rule field one one trapezoid 1 trapezoid_segment D) -> (r <= 1)%nat.
Proof.
  assert (exact : radiance field one one D = 1 - exp (- D)).
  { transitivity (HomogeneousSlab.exact_radiance 1 1 D).
    - apply (HomogeneousSlab.radiance_eq field 1 1). lra.
    - unfold HomogeneousSlab.exact_radiance. now rewrite !Rmult_1_l. }
  rewrite exact. clear exact.
  assert (gap : 0 < 1 - exp (- D) * (1 + D)).
  { assert (strict : 1 + D < exp D) by (apply exp_ineq1; lra).
    apply Rmult_lt_compat_l with (r := exp (- D)) in strict; [| apply exp_pos].
    rewrite <- exp_plus in strict. replace (- D + D) with 0 in strict by ring.
    rewrite exp_0 in strict. lra. }
  apply order_at_most_one with ((1 - exp (- D) * (1 + D)) / 2) (exp (- D) * (D / 2));
    [easy | lra |].
  intros n Hn short. assert (Hd := segment_length D n some_length Hn).
  assert (lower := transmittance_below D (D / INR n) n (segments_make_up n Hn) ltac:(lra)).
  rewrite linear_rule_of_one. set (d := D / INR n) in *. set (x := (1 - d) ^ n) in *.
  assert (below : x <= exp (- D)).
  { unfold x. rewrite <- (segments_make_up n Hn). fold d.
    replace (- (INR n * d)) with (INR n * - d) by ring. rewrite <- exp_pow.
    apply pow_incr. assert (1 + - d <= exp (- d)) by apply exp_ineq1_le. lra. }
  eapply Rle_trans; [| apply Rle_abs].
  assert (d * x <= d * exp (- D)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
End Order.
